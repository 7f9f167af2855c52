"""One film by many machines: Slurm on loopback, GNU parallel. test_many_machines.py PATH-OF-CLUCIDA [TEST ...]"""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from typing import ClassVar

from slurm_cluster import PACKAGES, Cluster, kill, path_of, processes_with, require, wait_for

PROGRAM = str(Path(sys.argv.pop(1)).absolute()) if len(sys.argv) > 1 else "clucida"
SCRIPT = str(Path(__file__).absolute().parent.parent / "scripts" / "render_array.sbatch")
NAME = "the scene.clu"  # needs its quotes
FRAMES = 12
QUICK = ("-s", "64x36")
SLOW = ("-s", "64x36", "--samples", "1024")  # a tenth of a second a frame or more: time to be killed in the middle,
ONE_THREAD = {"POCL_MAX_PTHREAD_COUNT": "1", "POCL_CPU_MAX_CU_COUNT": "1"}  # also on a machine of many processors
SCENE = f"""clucida 1
sequence {{ frames {FRAMES}; fps 25 }}
observer {{ eye [0, -6, 2]; look [0, 0, 0.8]; fov 45 }}
sky gradient {{ low 0.2; middle 0.8; high [0.2, 0.4, 1] }}
light {{ point [5, -5, 8] }}
optics glass {{ reflection 0.1; refraction 0.9; index 1.5 }}
optics floor {{ reflection 0.2; absorption [0.6, 0.5, 0.4] }}
object ball {{ solid sphere([sin(2*pi*t), 0, 1], 1); optics glass }}
object ground {{ solid plane([0, 0, 0], [0, 0, 1]); optics floor }}
"""
NAMES = [f"{i:04}.png" for i in range(1, FRAMES + 1)]


def share_of(shard: int, shards: int) -> list[str]:
    return NAMES[shard - 1 :: shards]


def frames_written(log: str) -> list[str]:
    """By what clucida says of each frame that it finished."""
    return re.findall(r"^frames/(\d+\.png): \d+ of \d+,", log, re.MULTILINE)


class ManyMachines(unittest.TestCase):
    cluster: ClassVar[Cluster]
    expected: ClassVar[dict[tuple[str, ...], dict[str, bytes]]]

    @classmethod
    def setUpClass(cls) -> None:
        require({**PACKAGES, "parallel": "parallel"})
        cls.cluster = Cluster()
        cls.addClassCleanup(cls.cluster.stop)
        # What a single process makes of it.
        cls.expected = {}
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / NAME).write_text(SCENE)
            for settings in (QUICK, SLOW):
                frames = Path(folder) / str(len(settings))
                frames.mkdir()
                command = [PROGRAM, "render", NAME, "-o", f"{frames}/%04d.png", *settings]
                done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
                if done.returncode:
                    raise RuntimeError(done.stderr)
                cls.expected[settings] = {p.name: p.read_bytes() for p in frames.iterdir()}
                assert sorted(cls.expected[settings]) == NAMES

    def setUp(self) -> None:
        temporary = tempfile.TemporaryDirectory(prefix="a film's ")  # and so does this
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / NAME).write_text(SCENE)
        self.frames = self.folder / "frames"
        self.frames.mkdir()

    def submit(self, array: str, settings: tuple[str, ...], scene: str = NAME) -> str:
        command = [
            "sbatch",
            "--parsable",
            f"--array={array}",
            "--cpus-per-task=1",
            SCRIPT,
            scene,
            "frames/%04d.png",
            *settings,
        ]
        job = self.cluster.command(*command, cwd=self.folder, CLUCIDA=PROGRAM).strip()
        self.addCleanup(self.cluster.cancel, job)
        return job

    def log(self, job: str, task: int) -> str:
        return (self.folder / f"slurm-{job}_{task}.out").read_text()

    def states(self, tasks: dict[int, dict[str, str]]) -> list[tuple[str, str]]:
        return [(tasks[i]["JobState"], tasks[i]["ExitCode"]) for i in sorted(tasks)]

    def there(self) -> dict[str, bytes]:
        """The frames that are there. A frame that was killed in the middle has another name, with a dot."""
        return {p.name: p.read_bytes() for p in self.frames.iterdir() if not p.name.startswith(".")}

    def times(self) -> dict[str, int]:
        return {name: (self.frames / name).stat().st_mtime_ns for name in self.there()}

    def check_whole(self, settings: tuple[str, ...]) -> None:
        self.assertEqual(
            sorted(p.name for p in self.frames.iterdir()), NAMES, "missing, or left behind by a killed process"
        )
        found = self.there()
        for name in NAMES:
            self.assertTrue(found[name] == self.expected[settings][name], f"{name} differs from a single process'")

    def check_cut_short(self, settings: tuple[str, ...]) -> None:
        found = self.there()
        self.assertTrue(0 < len(found) < FRAMES, f"killed too early or too late: {sorted(found)}")
        for name, data in found.items():
            self.assertTrue(data == self.expected[settings][name], f"{name} is there but not whole")

    def renderers(self, setting: str) -> list[int]:
        """Processes of clucida, in this test's folder, with NAME=VALUE in their environment."""
        return [p for p in processes_with(setting) if Path(f"/proc/{p}/cwd").resolve() == self.folder.resolve()]

    # Slurm

    def test_an_array_renders_every_frame_once(self) -> None:
        job = self.submit("1-3", QUICK)
        tasks = self.cluster.wait_for_end(job)
        self.assertEqual(self.states(tasks), [("COMPLETED", "0:0")] * 3, self.log(job, 1))
        self.assertEqual({t["NodeList"] for t in tasks.values()}, {"node1", "node2"})
        written = {i: sorted(frames_written(self.log(job, i))) for i in tasks}
        self.assertEqual(written, {i: share_of(i, 3) for i in (1, 2, 3)})
        self.check_whole(QUICK)

    def test_a_killed_tasks_frames_are_redone_by_the_same_command(self) -> None:
        job = self.submit("1-2", SLOW)
        wait_for("the second task's first frame", (self.frames / "0002.png").exists)
        kill(self.renderers("SLURM_ARRAY_TASK_ID=2"))
        states = self.states(self.cluster.wait_for_end(job))
        self.assertEqual(states[0], ("COMPLETED", "0:0"))
        self.assertEqual(states[1][0], "FAILED")
        self.check_cut_short(SLOW)
        before = self.times()

        again = self.submit("1-2", SLOW)
        self.assertEqual(self.states(self.cluster.wait_for_end(again)), [("COMPLETED", "0:0")] * 2)
        self.check_whole(SLOW)
        self.assertEqual(frames_written(self.log(again, 1)), [])
        self.assertEqual(sorted(frames_written(self.log(again, 2))), sorted(set(NAMES) - set(before)))
        self.assertEqual({name: self.times()[name] for name in before}, before, "what was right was written again")

    def test_a_lost_nodes_task_starts_again_on_another(self) -> None:
        job = self.submit("1-2", SLOW)
        wait_for("two tasks' first frames", lambda: all((self.frames / name).exists() for name in NAMES[:2]))
        lost = next(i for i, t in self.cluster.tasks(job).items() if t["NodeList"] == "node2")
        try:
            self.cluster.lose_node("node2")
            self.check_cut_short(SLOW)
            task = f"{job}_{lost}"
            wait_for("the task to be queued again", lambda: self.cluster.tasks(job)[lost]["JobState"] == "PENDING")
            self.cluster.command("scontrol", "update", f"JobId={task}", "StartTime=now")  # not in two minutes
            tasks = self.cluster.wait_for_end(job)
        finally:
            self.cluster.start_node("node2")
        self.assertEqual(self.states(tasks), [("COMPLETED", "0:0")] * 2)
        self.assertEqual((tasks[lost]["Restarts"], tasks[lost]["NodeList"]), ("1", "node1"))
        self.check_whole(SLOW)
        # Both attempts are in the log, and no frame was written in both.
        self.assertEqual(sorted(frames_written(self.log(job, lost))), share_of(lost, 2))

    def test_a_failure_is_the_tasks(self) -> None:
        job = self.submit("1-2", QUICK, scene="none.clu")
        self.assertEqual(self.states(self.cluster.wait_for_end(job)), [("FAILED", "2:0")] * 2)
        self.assertIn("none.clu", self.log(job, 1))
        self.assertEqual(self.there(), {})

    def test_part_of_an_array_is_refused(self) -> None:
        for array in ("2-3", "0-1", "1-3:2"):
            with self.subTest(array=array):
                job = self.submit(array, QUICK)
                self.assertEqual(self.states(self.cluster.wait_for_end(job)), [("FAILED", "2:0")] * 2)
        for arguments, expected in (([], "expected SCENE"), (["a.clu", "%d.png"], "sbatch --array=1-N")):
            done = subprocess.run([SCRIPT, *arguments], env=self.cluster.environment, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn(expected, done.stderr)
        self.assertEqual(self.there(), {})

    # GNU parallel

    def parallel(self, settings: tuple[str, ...]) -> subprocess.Popen[str]:
        command = [path_of("parallel") or "parallel", "-q", "-j2", "--joblog", "jobs", PROGRAM, "render", NAME]
        command += ["-o", "frames/%04d.png", *settings, "--shard", "{}/4", "--skip-existing", ":::", "1", "2", "3", "4"]
        environment = {**self.cluster.environment, **ONE_THREAD, "PARALLEL_HOME": str(self.folder)}
        process = subprocess.Popen(
            command, cwd=self.folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        self.addCleanup(lambda: kill(processes_with(f"PARALLEL_HOME={self.folder}")))
        return process

    def test_gnu_parallel_renders_every_frame_once(self) -> None:
        process = self.parallel(QUICK)
        _, err = process.communicate()
        self.assertEqual(process.returncode, 0, err)
        self.assertEqual(sorted(frames_written(err)), NAMES)
        self.check_whole(QUICK)

    def test_gnu_parallel_goes_on_where_a_shard_was_killed(self) -> None:
        process = self.parallel(SLOW)
        wait_for("the second shard's first frame", (self.frames / "0002.png").exists)
        arguments = {
            p: Path(f"/proc/{p}/cmdline").read_bytes().split(b"\0")
            for p in self.renderers(f"PARALLEL_HOME={self.folder}")
        }
        kill([p for p, words in arguments.items() if words[0] == os.fsencode(PROGRAM) and b"2/4" in words])
        process.communicate()
        self.assertEqual(process.returncode, 1, "the number of shards that failed")
        self.check_cut_short(SLOW)
        before = self.times()
        process = self.parallel(SLOW)
        _, err = process.communicate()
        self.assertEqual(process.returncode, 0, err)
        self.assertEqual(sorted(frames_written(err)), sorted(set(NAMES) - set(before)))
        self.check_whole(SLOW)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    unittest.main()
