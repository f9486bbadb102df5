"""Completes the stub that nanobind makes: numbers may be given as an array, too, which is no Sequence, and levels as any Sequence; and types of the
package, which it can't import. `complete_stub.py RAW.pyi OUT.pyi`"""

import pathlib
import re
import sys

if __name__ == "__main__":
    numbers = r"\b(?:collections\.abc\.)?Sequence\[float\]|(?<=x_ref: )list\[float\]"
    text = re.sub(numbers, "numpy.typing.ArrayLike", pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    text = re.sub(r"(?<=levels: )list\[(dict\[str, (?:typing\.)?Any\])\]", r"Sequence[\1]", text)
    text = re.sub(r"(?<=set_stack\(self, stack: )(?:typing\.)?Any", "surefoot.stack.Stack | str | os.PathLike[str]", text)
    pathlib.Path(sys.argv[2]).write_text("import surefoot.stack\n" + "import numpy.typing\n" * ("import numpy.typing\n" not in text) + text, encoding="utf-8")
