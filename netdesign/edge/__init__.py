"""Reading, writing and showing: where the program meets files and terminals."""
