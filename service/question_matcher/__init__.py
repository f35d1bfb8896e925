"""Questions that the grammar refuses, matched to known ones by a classifier learnt from examples."""
