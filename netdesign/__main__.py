"""``python -m netdesign``: the command line, where its script is not on the path."""

from netdesign.cli import main

if __name__ == "__main__":
    main()
