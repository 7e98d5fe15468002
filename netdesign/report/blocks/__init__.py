"""Reports as blocks: what stands where, for every writer."""
