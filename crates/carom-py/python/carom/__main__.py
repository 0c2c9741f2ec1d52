"""``python -m carom``: the command."""

from carom._command import main

main()
