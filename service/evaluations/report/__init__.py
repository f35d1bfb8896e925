"""Reports of evaluations: one document, written as HTML, Markdown or JSON, and the episodes as CSV."""
