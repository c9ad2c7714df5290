"""How every script of plots/ ends where it can't go on."""

import sys
from pathlib import Path


def stop(message):
    print(f"{Path(sys.argv[0]).name}: {message}", file=sys.stderr)
    sys.exit(2)
