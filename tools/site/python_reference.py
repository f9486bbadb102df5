"""The reference of the Python module, from its stub and its sources."""

import ast
import re

import prose

HEAD = "# Python reference\n\nGenerated from the module's types and docstrings. [Surefoot from Python](../python.md) is the introduction.\n"
# Their shapes stand in the docstrings.
ARRAY = re.compile(r"Annotated\[(?:numpy\.typing\.)?NDArray\[numpy\.\w+\], dict\(.*?\)\]")
STUB = "build/release/python/surefoot/_core.pyi"


def pages(root):
    stub = root / STUB
    if not stub.exists():
        raise SystemExit(f"{STUB} is missing: ninja -C build/release surefoot_python_stub")
    text = HEAD
    package = root / "python/surefoot"
    init = ast.parse((package / "__init__.py").read_text())
    text += module("surefoot", [stub, root / "python/surefoot_log/recorded.py", package / "__init__.py"], lambda name: name not in calls_only(init))
    shared = set(taken_from_modules(init))
    for file in sorted(package.glob("*.py")):
        defined = {name_of(entry) for entry in members(ast.parse(file.read_text()))}
        if file.stem != "__init__" and shared & defined:
            text += module("surefoot", [file], lambda name: name in shared, file.stem.removeprefix("_"))
    return {"reference/python.md": text + module("surefoot.tasks", [stub.with_name("tasks.py")], lambda name: True)}


def calls_only(init):
    """What the package calls of its compiled part, and keeps from its users; but Controller has the members of ControllerBase."""
    (names,) = [ast.literal_eval(entry.value) for entry in init.body if isinstance(entry, ast.Assign) and ast.unparse(entry.targets[0]) == "_INTERNAL"]
    return set(names) - {"ControllerBase"}


def module(name, files, is_meant, part=""):
    trees = [ast.parse(file.read_text()) for file in files]
    about = [text for tree in trees if (text := ast.get_docstring(tree))][-1:]  # the package's says what that of its compiled part does
    elsewhere = {name for tree in trees for name in taken_from_modules(tree)}
    entries = [entry for tree in trees for entry in members(tree) if is_public(entry) and name_of(entry) not in elsewhere and is_meant(name_of(entry))]
    order = {ast.ClassDef: 0, ast.FunctionDef: 1}
    entries.sort(key=lambda entry: order.get(type(entry), 2))
    parts = [f"\n## {name}{part and f': {part}'}\n", *(prose.to_html(text) + "\n" for text in about)]
    return "\n".join(parts + [described(entry, 3, name) for entry in entries])


def taken_from_modules(tree):
    """Names that stand in the package, and are described with the module that they come from."""
    imports = [entry for entry in tree.body if isinstance(entry, ast.ImportFrom) and entry.module.startswith("surefoot.")]
    return [alias.asname or alias.name for entry in imports if entry.module != "surefoot._core" for alias in entry.names]


def members(tree):
    return [entry for entry in tree.body if isinstance(entry, (ast.ClassDef, ast.FunctionDef, ast.AnnAssign))]


def name_of(entry):
    return entry.target.id if isinstance(entry, ast.AnnAssign) else entry.name


def is_public(entry):
    name = name_of(entry)
    return not name.startswith("_") or name == "__init__"


def described(entry, depth, parent):
    """Heading, signature and docstring; of a class also its members."""
    if isinstance(entry, ast.AnnAssign):
        return f"- `{name_of(entry)}: {ast.unparse(entry.annotation)}`\n"
    if isinstance(entry, ast.ClassDef):
        return a_class(entry, depth, parent)
    if is_property(entry):
        return field(entry)
    called = "()" if entry.name == "__init__" else f".{entry.name}"
    return f"{'#' * depth} {parent.removeprefix('surefoot.')}{called}\n\n```python\n{signature(entry)}\n```\n\n{about(entry)}\n"


def a_class(entry, depth, parent):
    bases = ", ".join(ast.unparse(base) for base in entry.bases)
    head = f"{'#' * depth} {entry.name}\n\n```python\nclass {entry.name}{f'({bases})' if bases else ''}\n```\n\n{about(entry)}\n"
    inside = [member for member in members(entry) if is_public(member)]
    name = entry.name.removesuffix("Base")  # of a compiled base: users call it by the class that they have
    fields = [member for member in inside if isinstance(member, ast.AnnAssign) or is_property(member)]
    methods = [member for member in inside if member not in fields]
    return head + "\n" + "".join(described(member, depth + 1, name) for member in fields) + "\n" + "\n".join(
        described(member, depth + 1, name) for member in methods)  # fmt: skip


def decorators(entry):
    return [ast.unparse(decorator) for decorator in entry.decorator_list]


def is_property(entry):
    return isinstance(entry, ast.FunctionDef) and any(name == "property" or name.endswith(".setter") for name in decorators(entry))


def field(entry):
    if any(name.endswith(".setter") for name in decorators(entry)):
        return ""
    kind = ARRAY.sub("ndarray", ast.unparse(entry.returns)) if entry.returns else "object"
    text = " ".join((ast.get_docstring(entry) or "").split())
    return f"- `{entry.name}: {kind}`{f' {prose.inline(text)}' if text else ''}\n"


def signature(entry):
    returns = f" -> {ast.unparse(entry.returns)}" if entry.returns else ""
    return "\n".join([*(f"@{name}" for name in decorators(entry)), f"def {entry.name}({ast.unparse(entry.args)}){returns}"])


def about(entry):
    text = ast.get_docstring(entry)
    return prose.to_html(text) + "\n" if text else ""
