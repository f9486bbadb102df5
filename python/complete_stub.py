"""Completes the stub that nanobind makes: numbers may be given as an array, too, which is no Sequence; and types of the package, which it can't
import. `complete_stub.py RAW.pyi OUT.pyi`"""

import pathlib
import re
import sys

if __name__ == "__main__":
    text = re.sub(r"\b(?:collections\.abc\.)?Sequence\[float\]", "numpy.typing.ArrayLike", pathlib.Path(sys.argv[1]).read_text())
    text = text.replace("set_stack(self, stack: typing.Any", "set_stack(self, stack: surefoot.stack.Stack | str")
    pathlib.Path(sys.argv[2]).write_text("import surefoot.stack\n" + "import numpy.typing\n" * ("import numpy.typing\n" not in text) + text)
