"""The command line as a program of its own."""

from acausal.cli import main

if __name__ == "__main__":
    main()
