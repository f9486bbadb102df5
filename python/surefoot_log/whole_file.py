"""Files that are there whole or not at all."""

import os
from contextlib import contextmanager

from surefoot_campaign.errors import InputError


def partial_name(path):
    """Nobody else's: NAME.partial may be the log of a run that was interrupted, or that is being recorded."""
    return f"{path}.{os.getpid()}.partial"


@contextmanager
def written_whole(path):
    """Gives another name to write to, so that nothing partial ever has the file's."""
    partial = partial_name(path)
    try:
        yield partial
        os.replace(partial, path)
    except OSError as error:
        raise InputError(f"{path}: can't be written: {error.strerror or error}") from None
    finally:
        if os.path.exists(partial):
            os.remove(partial)
