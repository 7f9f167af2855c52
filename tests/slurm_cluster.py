"""A Slurm cluster of one's own on loopback, of Debian's packages: munged, slurmctld and two nodes, each a slurmd.

It runs as root in a container and as an ordinary user, without systemd and cgroups. All that it is made of lies in one
temporary folder, and all that it started ends with it.
"""

from __future__ import annotations

import atexit
import contextlib
import ctypes
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

PACKAGES = {"munged": "munge", "slurmctld": "slurmctld", "slurmd": "slurmd", "sbatch": "slurm-client"}

CONFIGURATION = """
ClusterName=clucida
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
# Nodes have the processors that they are said to have, not those of this machine. Tasks start at once.
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0
KillWait=2
# Only jobs that ask for it start again when their node is lost.
JobRequeue=0
ReturnToService=2
NodeName=node1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1
NodeName=node2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1
PartitionName=all Nodes=ALL Default=YES State=UP
"""


def require(programs: dict[str, str]) -> None:
    """Fails, saying what to install, unless there are these programs; each with its Debian package."""
    missing = sorted({package for program, package in programs.items() if not path_of(program)})
    if missing:
        raise RuntimeError(f"missing: please run `apt install {' '.join(missing)}` or `scripts/setup test`")


def path_of(program: str) -> str | None:
    """Also of what lies where only root looks."""
    return shutil.which(program, path=os.environ.get("PATH", os.defpath) + ":/usr/sbin:/sbin")


def wait_for(what: str, condition: Callable[[], bool], seconds: float = 60) -> None:
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(f"in vain waited for {seconds} s: {what}")
        time.sleep(0.02)


def processes_with(*settings: str) -> list[int]:
    """Those whose environment has one of these NAME=VALUE; only our own can be looked into."""
    wanted = {s.encode() for s in settings}
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != os.getpid():
            with contextlib.suppress(OSError):
                if wanted & set((entry / "environ").read_bytes().split(b"\0")):
                    found.append(int(entry.name))
    return found


def kill(processes: Sequence[int]) -> None:
    for process in processes:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)


def free_ports(count: int) -> list[int]:
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for s in sockets:
            s.bind(("", 0))
        return [s.getsockname()[1] for s in sockets]


def die_with_parent() -> None:
    """In a child, before it becomes a daemon: even if the test is killed, that goes too. 1 is PR_SET_PDEATHSIG."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL, 0, 0, 0)


class Cluster:
    def __init__(self) -> None:
        require(PACKAGES)
        self.daemons: dict[str, subprocess.Popen[bytes]] = {}
        self.folder = Path(tempfile.mkdtemp(prefix="clucida-slurm-"))
        atexit.register(self.stop)
        try:
            self._start()
        except BaseException:
            self.stop()
            raise

    def _start(self) -> None:
        # Munge's socket must be reachable by everybody, its key by nobody else.
        self.folder.chmod(0o711)
        for name, mode in (("munge", 0o711), ("state", 0o700), ("node1", 0o700), ("node2", 0o700)):
            (self.folder / name).mkdir()
            (self.folder / name).chmod(mode)
        key = self.folder / "key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.configuration = self.folder / "slurm.conf"
        self.configuration.write_text(
            CONFIGURATION.format(
                folder=self.folder, user=os.getuid(), host=socket.gethostname().split(".")[0], ports=free_ports(3)
            )
        )
        # Marks all that descends from the daemons; jobs have it from sbatch.
        self.mark = f"SLURM_CONF={self.configuration}"
        self.environment = {k: v for k, v in os.environ.items() if not k.startswith(("SLURM_", "SBATCH_"))}
        self.environment["SLURM_CONF"] = str(self.configuration)
        self.environment["PATH"] = os.environ.get("PATH", os.defpath) + ":/usr/sbin:/sbin"
        self._daemon(
            "munged",
            *["munged", "--foreground", "--force", "--num-threads=2", f"--socket={self.folder}/munge/socket"],
            *[f"--{name}-file={self.folder}/{file}" for name, file in (("key", "key"), ("seed", "seed"))],
            *[f"--{name}-file={self.folder}/munged.{name}" for name in ("pid", "log")],
        )
        wait_for("munged", (self.folder / "munge" / "socket").exists, 20)
        self._daemon("slurmctld", "slurmctld", "-D", "-c", "-f", str(self.configuration))
        for node in ("node1", "node2"):
            self.start_node(node)

    def _daemon(self, name: str, *command: str) -> None:
        with (self.folder / f"{name}.out").open("ab") as out:
            self.daemons[name] = subprocess.Popen(
                [path_of(command[0]) or command[0], *command[1:]],
                env={**self.environment, "CLUCIDA_TEST_DAEMON": f"{self.folder}/{name}"},
                cwd=self.folder,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=out,
                preexec_fn=die_with_parent,
                start_new_session=True,  # Ctrl-C is for the test, which then stops them
            )

    def logs(self) -> str:
        return "\n".join(
            f"--- {p.name}\n{p.read_text(errors='replace')[-3000:]}" for p in sorted(self.folder.glob("*.out"))
        )

    def command(self, *arguments: str, cwd: Path | None = None, **environment: str) -> str:
        """Standard output of a Slurm command."""
        done = subprocess.run(
            arguments, cwd=cwd, env={**self.environment, **environment}, capture_output=True, text=True, timeout=60
        )
        if done.returncode:
            raise RuntimeError(f"{' '.join(arguments)}: {done.stderr}\n{self.logs()}")
        return done.stdout

    def state_of(self, node: str) -> str:
        """Such as idle, mixed, allocated, down; unknown while the controller does not answer."""
        with contextlib.suppress(RuntimeError):
            return self.command("sinfo", "-h", "-N", "-n", node, "-o", "%t").strip()
        return "unknown"

    def start_node(self, node: str) -> None:
        self._daemon(node, "slurmd", "-D", "-N", node, "-f", str(self.configuration))
        try:
            wait_for(f"{node} to be idle", lambda: self.state_of(node) == "idle", 30)
        except TimeoutError as error:
            raise TimeoutError(f"{error}\n{self.logs()}") from None

    def lose_node(self, node: str) -> None:
        """As if its power failed: everything on it is killed. The controller is told what it finds out in minutes."""
        kill(processes_with(f"CLUCIDA_TEST_DAEMON={self.folder}/{node}"))  # of this cluster: tests may run side by side
        ours = processes_with(self.mark)
        kill([p for p in processes_with(f"SLURMD_NODENAME={node}") if p in ours])
        self.daemons.pop(node).wait()
        self.command("scontrol", "update", f"NodeName={node}", "State=DOWN", "Reason=lost")

    def tasks(self, job: str) -> dict[int, dict[str, str]]:
        """What Slurm knows of each task of an array that has been started."""
        found = {}
        for line in self.command("scontrol", "show", "job", "-o", job).splitlines():
            fields = dict(word.split("=", 1) for word in line.split() if "=" in word)
            if fields.get("ArrayTaskId", "").isdigit():
                found[int(fields["ArrayTaskId"])] = fields
        return found

    def wait_for_end(self, job: str) -> dict[int, dict[str, str]]:
        wait_for(f"the end of job {job}", lambda: not self.command("squeue", "-h", "-j", job).strip())
        return self.tasks(job)

    def cancel(self, job: str) -> None:
        """What of it has not ended; then it has."""
        with contextlib.suppress(RuntimeError):  # for then it is none of the queue's any more
            self.command("scancel", job)
        self.wait_for_end(job)

    def stop(self) -> None:
        """Ends everything, jobs first; what does not is killed. May be called again."""
        if not self.folder.exists():
            return
        try:
            for name in ("node1", "node2", "slurmctld", "munged"):
                if name in self.daemons:
                    self.daemons[name].terminate()
            for daemon in self.daemons.values():
                with contextlib.suppress(subprocess.TimeoutExpired):
                    daemon.wait(5)
        finally:
            while left := processes_with(f"SLURM_CONF={self.folder}/slurm.conf"):
                kill(left)
                for daemon in self.daemons.values():
                    daemon.poll()
                time.sleep(0.01)
            shutil.rmtree(self.folder)
            atexit.unregister(self.stop)
