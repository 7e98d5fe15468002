"""Run time against error, and stability, of the program itself."""
