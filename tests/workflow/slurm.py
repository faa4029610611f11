"""A real Slurm on this machine: munged, slurmctld and two slurmd on loopback ports of their own.

Nothing of it touches a Slurm that the machine may have: key, sockets, state and logs lie in one folder.
There is no accounting, as on many small clusters.
"""

import getpass
import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

PROGRAMS = ("setpriv", "munged", "slurmctld", "slurmd", "sbatch", "scontrol", "scancel")
NODES = ("surge1", "surge2")
CPUS, MEMORY = 2, 4000  # of each node; Slurm counts them, and does not look whether they are there
# Jobs are not forgotten for a day, and a controller that the machine keeps from its work may be slow to answer.
CONFIGURATION = """ClusterName=surgefront
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=batch_sched_delay=0,sched_interval=1
KillWait=2
MinJobAge=100000
MessageTimeout=100
ReturnToService=2
SlurmdParameters=config_overrides
{nodes}
PartitionName=all Nodes={names} Default=YES MaxTime=INFINITE State=UP
"""


class NoSlurm(Exception):
    """Slurm cannot be started here, and why."""


def free_ports(number):
    """Ports of loopback that nothing listens to."""
    sockets = [socket.socket() for _ in range(number)]
    for place in sockets:
        place.bind(("127.0.0.1", 0))
    ports = [place.getsockname()[1] for place in sockets]
    for place in sockets:
        place.close()
    return ports


class Slurm:
    """Started in a folder; `environment` is what its commands need. To be stopped."""

    def __init__(self, folder: Path):
        path = f"{os.environ['PATH']}:/usr/sbin:/sbin"
        missing = [name for name in PROGRAMS if not shutil.which(name, path=path)]
        if missing:
            raise NoSlurm(f"{', '.join(missing)} not installed (packages slurm-wlm and munge)")
        self.folder = folder
        self.started = []
        self.environment = {**os.environ, "PATH": path, "SLURM_CONF": str(folder / "slurm.conf")}
        for name in [name for name in self.environment if name.startswith("SBATCH_")]:
            del self.environment[name]
        try:
            self._start()
        except BaseException:
            self.stop()
            raise

    def _start(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        (self.folder / "state").mkdir()
        for node in NODES:
            (self.folder / f"spool-{node}").mkdir()
        host = socket.gethostname().split(".")[0]
        controller, *ports = free_ports(1 + len(NODES))
        nodes = "\n".join(f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs={CPUS} "
                          f"RealMemory={MEMORY} State=UNKNOWN" for node, port in zip(NODES, ports))
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=host, controller=controller, user=getpass.getuser(), folder=self.folder, nodes=nodes,
            names=",".join(NODES)))
        self._daemon("munged", "--foreground", "--force", f"--key-file={key}",
                     f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munged.pid",
                     f"--log-file={self.folder}/munged.log", f"--seed-file={self.folder}/munged.seed")
        self._wait("munged", lambda: (self.folder / "munge.socket").exists())
        self._daemon("slurmctld", "-D")
        for node in NODES:
            self._daemon("slurmd", "-D", "-N", node)
        self._wait("slurmd", lambda: self.command("sinfo", "-h", "-N", "-o", "%T").split() == ["idle"] * len(NODES))

    def _daemon(self, *command):
        """In the foreground as a process of ours, which ends with us, however we end."""
        with open(self.folder / f"{command[0]}.out", "a", encoding="utf-8") as out:
            self.started.append(subprocess.Popen(["setpriv", "--pdeathsig", "TERM", *command],
                                                 stdin=subprocess.DEVNULL, stdout=out, stderr=out,
                                                 env=self.environment))

    def _wait(self, name, condition):
        deadline = time.monotonic() + 60
        while not condition():
            ended = [process.args[3] for process in self.started if process.poll() is not None]
            if ended or time.monotonic() > deadline:
                raise NoSlurm(f"{ended[0]} ended" if ended else f"{name} did not come up in 60 s" + self.logs())
            time.sleep(0.1)

    def logs(self):
        """The last lines of what the daemons wrote."""
        texts = [(path.name, path.read_text(errors="replace").splitlines()[-3:])
                 for path in sorted([*self.folder.glob("*.log"), *self.folder.glob("*.out")])]
        return "".join(f"\n{name}: {line}" for name, lines in texts for line in lines)

    def command(self, *words):
        """What a command of Slurm prints; nothing where it fails."""
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=False).stdout

    def stop(self):
        """Ends the daemons, the last one first."""
        for process in reversed(self.started):
            process.send_signal(signal.SIGTERM)
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
