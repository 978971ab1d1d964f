"""``python -m fuge`` is the command ``fuge``."""

import sys

from fuge.command import main

sys.exit(main())
