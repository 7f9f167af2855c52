#!/usr/bin/env python3
"""clang-tidy over many files, together: scripts/tidy.py FILE... [-- OPTION of clang-tidy...]

A translation unit that includes several files takes little longer than one of them: most time goes into the headers of
libraries. Files of one folder with the same compiler's options go together; where names of theirs collide, halves of
them do. The analyzer of clang looks at what a unit's own file has only, so it sees nothing here. Needs
build/compile_commands.json.
"""

import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build"
MOST = 16
# What is wrong in the files that are included is wanted.
TOGETHER = ("--header-filter=/(scene|host|bench)/[^.]*[.](h|cpp)$",)


def compilers() -> dict[str, str]:
    """The compiler's call for each file, without the file."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    return {os.path.relpath(e["file"], ROOT): re.sub(r" -o \S+ -c \S+", "", e["command"]) for e in entries}


def groups(files: list[str], calls: dict[str, str]) -> list[list[str]]:
    alike: dict[tuple[str, str, str], list[str]] = {}
    for file in files:
        alone = file if "int main(" in (ROOT / file).read_text() else ""
        alike.setdefault((str(Path(file).parent), calls[file], alone), []).append(file)
    out = []
    for some in alike.values():
        parts = -(-len(some) // MOST)
        out += [some[i::parts] for i in range(parts)]
    return sorted(out, key=len, reverse=True)


def run(*command: str) -> subprocess.CompletedProcess:
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


def tidy(files: list[str], call: str, options: list[str]) -> str:
    """What clang-tidy has to say of the files; empty if nothing."""
    with tempfile.TemporaryDirectory() as folder:
        unit = Path(folder) / "together.cpp"
        unit.write_text("".join(f'#include "{ROOT / file}"\n' for file in files))
        flags = [*shlex.split(call)[1:], *(o.removeprefix("--extra-arg=") for o in options if o.startswith("--extra-arg="))]
        flags = [f for f in flags if not f.startswith("-f")]  # of GCC's code
        if len(files) > 1 and run("clang++", *flags, "-w", "-fsyntax-only", str(unit)).returncode != 0:
            return tidy(files[::2], call, options) + tidy(files[1::2], call, options)
        commands = [{"directory": str(BUILD), "file": str(unit), "command": f"{call} -c {unit}"}]
        (Path(folder) / "compile_commands.json").write_text(json.dumps(commands))
        done = run("clang-tidy", f"--config-file={ROOT / '.clang-tidy'}", "-p", folder, "--quiet", *TOGETHER, *options, str(unit))
    return "" if done.returncode == 0 else done.stdout or done.stderr


def main() -> int:
    end = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    files, options = sys.argv[1:end], sys.argv[end + 1 :]
    calls = compilers()
    if missing := [file for file in files if file not in calls]:
        sys.exit(f"tidy.py: not built, so nobody knows how: {', '.join(missing)}")
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = "".join(pool.map(lambda some: tidy(some, calls[some[0]], options), groups(files, calls)))
    print(found, end="")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
