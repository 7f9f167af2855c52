"""What the tests share. CLUCIDA names the program under test, as for users."""

import os
import sys
from pathlib import Path

from hypothesis import HealthCheck, settings

TREE = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TREE / "scene/python"), str(Path(__file__).resolve().parent)]
os.environ["CLUCIDA"] = os.path.abspath(os.environ.get("CLUCIDA", TREE / "build/clucida"))

# Most of what is tested does not depend on the device: the native one compiles nothing. Else this one is used.
OPENCL = os.environ.get("CLUCIDA_DEVICE", "cpu")
os.environ["CLUCIDA_DEVICE"] = "native"

# The program is started for each example: fewer of them, which take their time; and the same ones at each run.
settings.register_profile(
    "clucida", max_examples=40, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow]
)
settings.load_profile("clucida")
