"""python -m clucida: the program, with its arguments."""

import sys

from .program import run_program

sys.exit(run_program())
