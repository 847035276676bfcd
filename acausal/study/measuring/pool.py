"""Parallel runs of the cases of a study, in processes or on the workers of a cluster."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Iterable, Iterator
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, as_completed
from contextlib import AbstractContextManager, contextmanager, nullcontext
from typing import Any

from acausal.errors import DeclarationError, SimulationError
from acausal.study.measuring.case import Job, Measurement
from acausal.study.measuring.measure import measure
from acausal.study.measuring.study_arguments import check_counts
from acausal.study.measuring.workers import Workers, initialise, without_main

# One thread each: parallel cases would compete for the threads of linear algebra, and distort the measured times.
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")

LOOPBACK = "127.0.0.1"


def run(jobs: Iterable[Job], executor: Executor) -> Iterator[Measurement]:
    """Measure cases and yield each measurement when it is complete.

    Parameters
    ----------
    jobs : iterable of Job
        The jobs.
    executor : Executor
        From `processes` or `cluster`, or another executor as in concurrent.futures.
    """
    futures: list[Future[Measurement]] = [executor.submit(measure, job) for job in jobs]
    try:
        for future in as_completed(futures):
            yield future.result()
    except BrokenExecutor:
        raise SimulationError(
            "a worker process died: it ran out of memory or was killed, or the script runs the study again when it is "
            'imported: put the study under `if __name__ == "__main__":`.'
        ) from None
    finally:
        for future in futures:
            future.cancel()


def executor_of(executor: Executor | str | None, workers: int | None) -> AbstractContextManager[Executor]:
    """Return the executor of the cases: processes on this machine, a cluster by its address, or a given one.

    Parameters
    ----------
    executor : Executor, str or None
        An executor as in concurrent.futures, the address of a Dask scheduler, "local", or None for processes.
    workers : int, optional
        Number of local processes; one for each core if not given.
    """
    if executor is None:
        return processes(workers)
    if isinstance(executor, str):
        return cluster(executor, workers)
    if not callable(getattr(executor, "submit", None)):
        many = isinstance(executor, int) and not isinstance(executor, bool)
        count = f"for {executor} processes write workers={executor}. Otherwise " if many else ""
        raise DeclarationError(
            f"executor is {executor!r}; {count}it must be an executor of concurrent.futures, or the address of a Dask scheduler."
        )
    return nullcontext(executor)


@contextmanager
def processes(workers: int | None = None) -> Iterator[Executor]:
    """Yield an executor of processes on this machine, each with one thread for linear algebra.

    Parameters
    ----------
    workers : int, optional
        Number of processes; one for each core if not given.
    """
    if workers is not None:
        check_counts(workers=workers)
    before = set(multiprocessing.active_children())
    pool = ProcessPoolExecutor(workers or _cores(), Workers(), initialise)
    with _one_thread():
        try:
            yield pool
        except BaseException:
            # Do not wait for running cases.
            for process in set(multiprocessing.active_children()) - before:
                process.terminate()
            raise
        finally:
            pool.shutdown(cancel_futures=True)


@contextmanager
def cluster(address: str = "local", workers: int | None = None) -> Iterator[Executor]:
    """Yield an executor of Dask workers.

    Parameters
    ----------
    address : str
        Address of the scheduler, such as "tcp://10.0.0.1:8786"; "local" starts a scheduler and workers on this machine.
    workers : int, optional
        Number of local workers; one for each core if not given.
    """
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        raise DeclarationError(
            "studies on a cluster need Dask: python -m pip install 'acausal[cluster]'. Without it they run in "
            "processes on this machine."
        ) from None
    if address != "local":
        try:
            client = Client(address, timeout="10s")
        except (OSError, ValueError) as error:
            raise DeclarationError(f"there is no Dask scheduler at {address or 'no address'}: {error}") from None
        with client:
            yield client.get_executor(pure=False)
        return
    # A scheduler runs code for anyone who can connect: listen on the loopback interface only.
    here: dict[str, Any] = {"host": LOOPBACK, "dashboard_address": f"{LOOPBACK}:0"}
    with without_main():
        local = LocalCluster(n_workers=workers or _cores(), threads_per_worker=1, processes=True, **here)
    with local, Client(local) as client:
        yield client.get_executor(pure=False)


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def _one_thread() -> Iterator[None]:
    """Limit processes started inside the block to one thread for linear algebra."""
    before = {name: os.environ.get(name) for name in THREADS}
    os.environ.update(dict.fromkeys(THREADS, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
