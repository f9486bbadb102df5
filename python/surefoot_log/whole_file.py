"""Files that are there whole or not at all."""

import os
from contextlib import contextmanager

from surefoot_campaign.errors import InputError


@contextmanager
def written_whole(path):
    """Gives another name to write to, so that nothing partial ever has the file's."""
    partial = f"{path}.partial"
    try:
        yield partial
        os.replace(partial, path)
    except OSError as error:
        raise InputError(f"{path}: can't be written: {error.strerror or error}") from None
    finally:
        if os.path.exists(partial):
            os.remove(partial)
