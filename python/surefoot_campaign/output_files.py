"""Folders and logs that runs write: this call's alone meanwhile, and none of an earlier run beside those of the next."""

import contextlib
import fcntl
import os
import pathlib

from surefoot_campaign.errors import InputError


def with_seed(file, seed):
    """ "run.mcap" → "run-seed7.mcap"."""
    path = pathlib.Path(file)
    return str(path.with_name(f"{path.stem}-seed{seed}{path.suffix}"))


def holder(fd):
    """ " (process 4711)" of a lock's holder, if the kernel shows it."""
    place = f":{os.fstat(fd).st_ino}"
    with contextlib.suppress(OSError):
        for line in pathlib.Path("/proc/locks").read_text().splitlines():  # "3: FLOCK  ADVISORY  WRITE 4711 00:2f:1234567 0 EOF"
            _, kind, _, _, process, file, *_ = line.split()
            if kind == "FLOCK" and file.endswith(place):
                return f" (process {process})"
    return ""


@contextlib.contextmanager
def locked(path, shown):
    """This process's alone, as logging/write_lock.hpp has it for runs."""
    fd = os.open(path, os.O_RDONLY)
    try:
        fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    except BlockingIOError:
        raise InputError(f"{shown}: is being written by another run{holder(fd)}; wait for it, or choose another name") from None
    finally:
        os.close(fd)


@contextlib.contextmanager
def folder_of_our_own(folder):
    """Made if there is none; gone again if nothing is in it at the end."""
    is_new = not os.path.exists(folder)
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise InputError(f"{folder}: this folder can't be made: {error.strerror}") from None
    try:
        with locked(folder, folder):
            yield
    finally:
        if is_new:
            remove_if_empty(folder)


def remove_if_empty(folder):
    with contextlib.suppress(OSError):
        os.rmdir(folder)


def check_not_being_written(log):
    partial = f"{log}.partial"
    if os.path.exists(partial):
        with locked(partial, log):
            pass


def remove_outdated(report, log=None):
    """The page of a report, and a log with what a crash left of it."""
    if log:
        check_not_being_written(log)
    for file in [f"{report}/index.html", *([log, f"{log}.partial"] if log else [])]:
        pathlib.Path(file).unlink(missing_ok=True)
