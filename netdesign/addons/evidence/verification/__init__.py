"""The program against truth: closed forms, manufactured solutions, invariants."""
