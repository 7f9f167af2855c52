"""python -m clucida: the program, with its arguments."""

import sys

from .program import main

sys.exit(main())
