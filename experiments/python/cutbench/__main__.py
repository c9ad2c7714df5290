"""The program: python -m cutbench SUBCOMMAND ..."""

import sys

from . import _core


def main():
    sys.exit(_core.command_line(sys.argv[1:], [], None))


if __name__ == "__main__":
    main()
