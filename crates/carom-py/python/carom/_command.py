"""The ``carom`` command, as ``pip install`` puts it on the path."""

import signal
import sys

from carom import _carom


def main() -> None:
    """Run the command with the process's own words."""
    # Ctrl-C ends the command at once, as it does its own program
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    _carom.command(["carom", *sys.argv[1:]])
