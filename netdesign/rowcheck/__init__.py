"""One net row against one profile: effects, intervals, what would change it."""
