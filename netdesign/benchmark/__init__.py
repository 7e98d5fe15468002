"""Run time against error, and stability under stress, of the program itself."""
