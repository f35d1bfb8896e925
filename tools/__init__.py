"""Programs that people run: checks too long for the tests, pictures, figures."""
