"""Files and folders that are written whole or not at all, by one call at a time, and of which none of an earlier run stay."""

import contextlib
import fcntl
import os
import pathlib

from surefoot_campaign.errors import InputError


def partial_name(path):
    """A name that only this process uses: NAME.partial may be the log of a run that was interrupted, or that is being recorded."""
    return f"{path}.{os.getpid()}.partial"


@contextlib.contextmanager
def written_whole(path):
    """Gives a temporary name to write to; the file gets its own name once it is whole."""
    partial = partial_name(path)
    try:
        yield partial
        os.replace(partial, path)
    except OSError as error:
        raise InputError(f"{path}: can't be written: {error.strerror or error}") from None
    finally:
        pathlib.Path(partial).unlink(missing_ok=True)


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
    """Locks a file or folder for this process, as logging/write_lock.hpp does for runs."""
    fd = os.open(path, os.O_RDONLY)
    try:
        fcntl.flock(fd, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    except BlockingIOError:
        raise InputError(f"{shown}: is being written by another run{holder(fd)}; wait for it, or choose another name") from None
    finally:
        os.close(fd)


def make_folder(folder):
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise InputError(f"{folder}: this folder can't be made: {error.strerror}") from None


@contextlib.contextmanager
def folder_of_our_own(folder):
    """Makes and locks a folder. Removes it in the end if it is new and empty."""
    is_new = not os.path.exists(folder)
    make_folder(folder)
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
    """Removes the page of a report, and a log with what a crash left of it."""
    if log:
        check_not_being_written(log)
    for file in [f"{report}/index.html", *([log, f"{log}.partial"] if log else [])]:
        pathlib.Path(file).unlink(missing_ok=True)
