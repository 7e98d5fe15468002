"""Two versions of the program timed beside each other, each in turn."""
