"""One file for each version of the tables, written out: later changes of `tables` must not reach them."""
