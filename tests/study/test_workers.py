"""Runs spread over processes by Dask: the same results, also where a worker dies."""

import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager, nullcontext, suppress
from pathlib import Path

import dask
import distributed  # noqa: F401  its defaults before those of a test
import numpy as np
import pandas as pd
import pytest

from functions import dtlz2, slow, srn
from suspension_ctrl import MeasuredRoad, Nsga2, Problem, minimise
from suspension_ctrl.search.sampling import Sampling
from suspension_ctrl.study import calls
from suspension_ctrl.study import workers as clusters
from suspension_ctrl.study.study import Study


def study() -> Study:
    problem = Problem(evaluate=slow, lower=(0,) * 4, upper=(1,) * 4, objectives=("f1", "f2"))
    return Study(
        problems={"slow": problem},
        algorithms={"nsga2": Nsga2(population=20), "sobol": Sampling(population=20)},
        seeds=range(6),
        budgets=[40, 200],
    )


@pytest.fixture(scope="module")
def alone() -> pd.DataFrame:
    return study().run().drop(columns="seconds")


@pytest.fixture(scope="module")
def cluster():
    with clusters.local_cluster(2) as client:
        yield client


def test_two_workers_give_what_one_process_gives(alone, cluster):
    pd.testing.assert_frame_equal(study().run(cluster).drop(columns="seconds"), alone)


def test_runs_of_a_worker_that_dies_are_made_elsewhere(alone):
    with clusters.local_cluster(2) as client:
        victim, _ = client.run(os.getpid).values()
        store = {}
        made = study().carry_out(store, client)
        next(made)
        os.kill(victim, getattr(signal, "SIGKILL", signal.SIGTERM))
        assert not any(failure for _, failure in made)
        assert victim not in client.run(os.getpid).values()
    pd.testing.assert_frame_equal(study().table(store).drop(columns="seconds"), alone)


@contextmanager
def running(folder: Path, *command: str):
    """A process of its own, with the modules of the tests at hand."""
    path = os.pathsep.join([str(Path(__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        [sys.executable, "-m", *command], cwd=folder, env=os.environ | {"PYTHONPATH": path},
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        yield process
    finally:
        process.terminate()
        process.wait(20)


def address_in(file: Path) -> str:
    """The scheduler's address, once it has written all of it."""
    while True:
        with suppress(FileNotFoundError, json.JSONDecodeError):
            return json.loads(file.read_text(encoding="utf-8"))["address"]
        time.sleep(0.05)


def test_a_scheduler_gives_the_same_also_when_one_of_its_workers_is_killed(alone, tmp_path):
    """Real processes: a scheduler, two workers without a nanny, of which one is killed during the campaign."""
    file = tmp_path / "scheduler.json"
    scheduler = ("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    with running(tmp_path, *scheduler, "--scheduler-file", str(file)):
        address = address_in(file)
        worker = ("distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard")
        with (
            running(tmp_path, *worker) as first,
            running(tmp_path, *worker),
            clusters.scheduler_at(address) as client,
        ):
            client.wait_for_workers(2, timeout=60)
            store = {}
            made = study().carry_out(store, client)
            next(made)
            first.kill()
            assert not any(failure for _, failure in made)
    pd.testing.assert_frame_equal(study().table(store).drop(columns="seconds"), alone)


class Started:
    """A context whose client starts when it is told to; it keeps what happens."""

    def __init__(self, error: Exception | None = None):
        self.go, self.error, self.done = threading.Event(), error, []

    def __enter__(self):
        self.go.wait(10)
        if self.error:
            raise self.error
        self.done.append("entered")
        return self

    def nthreads(self):
        return {}

    def __exit__(self, kind, *_):
        self.done.append(kind)


@pytest.mark.skipif(sys.platform == "win32", reason="a process there cannot interrupt itself alone")
def test_a_start_that_is_interrupted_leaves_no_loop():
    """In whatever process: a shell starts those in the background without interrupts."""
    before, handler = loops(), signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
    try:
        with pytest.raises(KeyboardInterrupt), clusters.local_cluster(1):
            time.sleep(20)
    finally:
        signal.signal(signal.SIGINT, handler)
    assert loops() == before


def test_a_cluster_starts_beside_other_work():
    context = Started()
    with clusters.begun(context) as client:
        assert context.done == []
        context.go.set()
        assert client() is context
        assert context.done == ["entered"]
    assert context.done == ["entered", None]


def test_a_cluster_that_is_not_waited_for_is_left():
    """With the error of the other work, which processes need to know that they are to be killed."""
    context = Started()
    context.go.set()
    with pytest.raises(KeyError), clusters.begun(context):
        raise KeyError
    assert context.done == ["entered", KeyError]


def test_an_error_of_a_start_is_raised_where_it_is_waited_for():
    context = Started(ChildProcessError("processes must start"))
    context.go.set()
    with clusters.begun(context) as client, pytest.raises(ChildProcessError, match=r"^processes must start$"):
        client()
    assert context.done == []


def test_workers_import_what_will_be_needed(cluster):
    def imported() -> bool:
        return "suspension_ctrl.roads.measured" in sys.modules

    assert not any(cluster.run(imported).values())
    with clusters.begun(nullcontext(cluster), MeasuredRoad) as client:
        while not all(client().run(imported).values()):
            time.sleep(0.05)


class Here:
    """A client that works in this process."""

    def map(self, function, parts, pure, **given):
        return [function(part, **given) for part in parts]

    def gather(self, results):
        return results


def test_a_distributed_problem_has_the_same_kinds():
    problem = Problem(
        evaluate=slow,
        lower=(0,) * 4,
        upper=(9,) * 4,
        objectives=("f1", "f2"),
        kinds={"x1": "integer", "x2": (1, 3)},
    )
    made = clusters.distributed(problem, Here(), chunk=3)
    assert made.kinds == problem.kinds
    runs = [minimise(one, Nsga2(population=20), iterations=2, seed=1) for one in (made, problem)]
    np.testing.assert_array_equal(runs[0].designs, runs[1].designs)
    assert set(runs[0].designs[:, 1]) <= {1.0, 3.0}


@pytest.mark.skipif(shutil.which("openssl") is None, reason="openssl makes the certificate")
def test_tls_is_set_up_by_dasks_own_configuration(tmp_path):
    """With certificates it works as without encryption; without them there is no answer."""
    file, certificate = tmp_path / "scheduler.json", tmp_path / "cert.pem"
    files = {"ca-file": certificate, "client.cert": certificate, "client.key": tmp_path / "key.pem"}
    make = "openssl req -x509 -newkey rsa:2048 -nodes -days 1 -subj /CN=localhost -out cert.pem -keyout key.pem"
    subprocess.run(make.split(), cwd=tmp_path, check=True, capture_output=True)
    tls = ("--tls-ca-file", "cert.pem", "--tls-cert", "cert.pem", "--tls-key", "key.pem", "--no-dashboard")
    scheduler = ("distributed.cli.dask_scheduler", "--protocol", "tls", "--host", "127.0.0.1", "--port", "0")
    with running(tmp_path, *scheduler, "--scheduler-file", str(file), *tls):
        address = address_in(file)
        assert address.startswith("tls://")
        with (
            running(tmp_path, "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny", *tls),
            dask.config.set({f"distributed.comm.tls.{name}": str(path) for name, path in files.items()}),
            clusters.scheduler_at(address) as client,
        ):
            assert [*calls.outcomes(divmod, {"a": (7, 2)}, client)] == [("a", (3, 1), "")]
        with (
            pytest.raises(ValueError, match=r"^scheduler must be one that answers, got 'tls://"),
            clusters.scheduler_at(address, timeout=1.0),
        ):
            pass


@pytest.mark.skipif(not Path("/proc/net/tcp").exists(), reason="the system does not list sockets there")
def test_a_local_cluster_listens_on_loopback_alone(cluster):
    sockets = set()
    for pid in (os.getpid(), *cluster.run(os.getpid).values()):
        links = [os.readlink(path) for path in Path(f"/proc/{pid}/fd").iterdir() if path.is_symlink()]
        sockets |= {link[8:-1] for link in links if link.startswith("socket:[")}
    rows = [
        line.split() for file in ("tcp", "tcp6") for line in Path("/proc/net", file).read_text().splitlines()[1:]
    ]
    listening = [address for _, address, _, state, *rest in rows if state == "0A" and rest[5] in sockets]
    assert len(listening) >= 3  # the scheduler and two workers
    assert all(address.startswith("0100007F:") for address in listening)


def test_a_scheduler_that_is_lost_or_has_no_worker_is_told_in_one_line(tmp_path):
    file = tmp_path / "scheduler.json"
    command = ("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    with running(tmp_path, *command, "--scheduler-file", str(file)) as scheduler:
        address = address_in(file)
        with (
            pytest.raises(ValueError, match=r"^scheduler must have a worker"),
            clusters.scheduler_at(address, timeout=1.0),
        ):
            pass
        worker = ("distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard")
        with running(tmp_path, *worker), clusters.scheduler_at(address) as client:
            made = study().carry_out({}, client)
            next(made)
            scheduler.kill()
            with pytest.raises(ConnectionError, match=r"^scheduler lost: "):
                list(made)


def test_an_evaluation_spread_over_workers_gives_the_same_run(cluster):
    spread = clusters.distributed(dtlz2(5), cluster, chunk=7)
    ours, theirs = (minimise(p, Nsga2(population=20), iterations=3, seed=1) for p in (dtlz2(5), spread))
    np.testing.assert_array_equal(ours.objectives, theirs.objectives)
    assert (spread.variables, spread.objectives) == (dtlz2(5).variables, dtlz2(5).objectives)
    assert spread.constraints == ()
    assert clusters.distributed(srn(), cluster).constraints == ("g1", "g2")
    with pytest.raises(ValueError, match=r"^chunk must be a whole number >= 1, got 0$"):
        clusters.distributed(dtlz2(5), cluster, chunk=0)


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("localhost:8786", "scheduler must be tcp://host:port or tls://host:port, got 'localhost:8786'$"),
        ("tcp://127.0.0.1:1", "scheduler must be one that answers, got 'tcp://127.0.0.1:1': "),
        ("tls://127.0.0.1:1", "scheduler must be one that answers, got 'tls://127.0.0.1:1': TLS expects"),
    ],
)
def test_rejects_addresses_where_no_scheduler_is(address, message):
    """A client that fails leaves no loop to the garbage collector, which may come while the next one starts."""
    before = loops()
    with pytest.raises(ValueError, match=f"^{message}"), clusters.scheduler_at(address, timeout=0.5):
        pass
    assert loops() == before


def loops() -> set[threading.Thread]:
    return {thread for thread in threading.enumerate() if thread.name == "IO loop"}


def test_rejects_bad_numbers_of_jobs():
    with pytest.raises(ValueError, match=r"^jobs must be a whole number >= 1, got 0$"), clusters.local_cluster(0):
        pass


@pytest.mark.parametrize(
    ("body", "status", "said"),
    [
        ("with local_cluster(1) as client:\n    print(client.submit(abs, -1).result())", 1, "error: process"),
        (
            "if __name__ == '__main__':\n    with local_cluster(1) as client:\n"
            "        print(client.submit(abs, -1).result())",
            0, "",
        ),
    ],
)  # fmt: skip
def test_a_script_without_a_main_guard_is_told_in_one_line(tmp_path, body, status, said):
    script = tmp_path / "script.py"
    script.write_text(f"from suspension_ctrl.study.workers import local_cluster\n{body}\n")
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True)
    assert done.returncode == status
    assert done.stderr.count("\n") == bool(said)
    assert done.stderr.startswith(said)
    assert "script.py" in done.stderr or not said
    assert done.stdout == ("" if said else "1\n")


def test_processes_that_die_at_their_start_are_told_in_one_line(tmp_path):
    program = (
        "from suspension_ctrl.study.workers import local_cluster\n"
        "try:\n    local_cluster(2).__enter__()\nexcept OSError as error:\n    print(error)"
    )
    environment = os.environ | {"DASK_DISTRIBUTED__WORKER__PRELOAD": "import os; os._exit(3)"}
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, env=environment)
    assert done.stdout.startswith("processes must start, got: ")
    assert done.stdout.count("\n") == 1
    assert done.stderr == ""


def test_a_worker_of_another_version_is_refused(tmp_path, monkeypatch):
    """A folder of a package's metadata, ahead on the path of the worker alone, makes it scipy 0.1."""
    other = tmp_path / "scipy-0.1.dist-info"
    other.mkdir()
    (other / "METADATA").write_text("Metadata-Version: 2.1\nName: scipy\nVersion: 0.1\n")
    file = tmp_path / "scheduler.json"
    command = ("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")
    with running(tmp_path, *command, "--scheduler-file", str(file)):
        address = address_in(file)
        monkeypatch.setenv("PYTHONPATH", os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")]))
        worker = ("distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard")
        with (
            running(tmp_path, *worker),
            pytest.raises(
                ValueError, match=r"^scheduler must have workers with scipy \S+ as here, got 0.1 at tcp:"
            ),
            clusters.scheduler_at(address, timeout=30.0),
        ):
            pass


def test_clusters_follow_one_another_in_a_new_process(tmp_path):
    """Settings of the first one take none of Dask's defaults with them."""
    script = tmp_path / "script.py"
    script.write_text(
        "from suspension_ctrl.study.workers import local_cluster\n"
        'if __name__ == "__main__":\n'
        "    for jobs in (1, 2):\n"
        "        with local_cluster(jobs) as client:\n"
        "            print(len(client.scheduler_info()['workers']))\n"
    )
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=120, check=False)
    assert (done.stdout, done.stderr) == ("1\n2\n", "")
