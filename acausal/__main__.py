"""`python -m acausal` is the `acausal` command."""

from acausal.cli import main

if __name__ == "__main__":
    main()
