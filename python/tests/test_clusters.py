"""The examples on clusters of two workers, one of which is killed in the middle: no sample is lost or counted twice."""

import importlib
import os
import signal
import sys
import threading
import time
from pathlib import Path

import pytest
import surefoot

SAMPLES = 64
sys.path.insert(0, str(Path(__file__).parent.parent / "examples"))


def expected(study: surefoot.Study) -> dict:
    return study.certificate(study.run(range(SAMPLES)), samples=SAMPLES)


def killed_after(seconds: float, pid: int) -> threading.Timer:
    timer = threading.Timer(seconds, os.kill, (pid, signal.SIGKILL))
    timer.start()
    return timer


def test_dask_loses_a_worker(short_scene, vary):
    distributed = pytest.importorskip("dask.distributed")
    example = importlib.import_module("certify_dask")
    study = surefoot.Study(short_scene, vary)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            pids = list(client.run(os.getpid).values())
            began = time.monotonic()
            timer = killed_after(0.3, pids[0])
            found = example.certify(client, study, SAMPLES)
            timer.join()
            # It was killed while there was work.
            assert time.monotonic() - began > 0.3
    assert found == expected(study)


def test_ray_loses_a_worker(short_scene, vary):
    ray = pytest.importorskip("ray")
    example = importlib.import_module("certify_ray")
    study = surefoot.Study(short_scene, vary)
    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:

        @ray.remote
        def pid() -> int:
            time.sleep(0.3)
            return os.getpid()

        pids = ray.get([pid.remote() for _ in range(2)])
        began = time.monotonic()
        timer = killed_after(0.3, pids[0])
        found = example.certify(study, SAMPLES)
        timer.join()
        assert time.monotonic() - began > 0.3
    finally:
        ray.shutdown()
    assert found == expected(study)
