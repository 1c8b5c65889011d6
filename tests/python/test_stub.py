"""The types of the Python package: the stub of the module has those of the module, and nothing public lacks them.

SWELL_SOURCE_DIR is the repository.
"""

import ast
import os
import re
from pathlib import Path

from swell import _swell

PACKAGE = Path(os.environ["SWELL_SOURCE_DIR"]) / "python" / "swell"
# The module prints a type as what it converts to, the stub has what may be given.
AS_PRINTED = {"Sequence[": "List[", "list[": "List[", "npt.NDArray[np.": "numpy.ndarray[numpy.",
              "npt.ArrayLike": "numpy.ndarray[numpy.float64]", "np.ndarray": "numpy.ndarray"}


def members(scope):
    """{name: node} of the functions and classes of a module or a class."""
    return {node.name: node for node in scope.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}


def stub_text(annotation, aliases):
    """A type of the stub in the module's words."""
    text = ast.unparse(annotation)
    while match := re.search(r"\b_[A-Z]\w*", text):
        text = text.replace(match[0], aliases[match[0]])
    for ours, printed in AS_PRINTED.items():
        text = text.replace(ours, printed)
    return text


def stub_signature(function, aliases):
    arguments = [f"{a.arg}: {stub_text(a.annotation, aliases)}" for a in function.args.args if a.arg != "self"]
    return f"({', '.join(arguments)}) -> {stub_text(function.returns, aliases)}"


def module_signature(function):
    """What pybind11 wrote in the first line of a function's help, without lengths of tuples."""
    line = function.__doc__.split("\n")[0]
    line = re.sub(r"\[\d+\]", "", line.replace("swell._swell.", ""))
    return re.sub(r"^\w+\(self: \w+(, )?", "(", line) if "(self: " in line else line[line.index("("):]


def names(scope):
    """Those that a module or a class has of its own, with __init__ where its help has a signature."""
    own = {name for name in vars(scope) if not name.startswith("_")}
    return own | ({"__init__"} if "(self: " in (scope.__init__.__doc__ or "") else set())


def test_the_stub_has_the_names_and_signatures_of_the_module():
    stub = ast.parse((PACKAGE / "_swell.pyi").read_text())
    aliases = {node.targets[0].id: ast.unparse(node.value) for node in stub.body if isinstance(node, ast.Assign)}
    top = members(stub)
    assert set(top) == names(_swell)
    told = {name: node for name, node in top.items() if isinstance(node, ast.FunctionDef)}
    for name, node in top.items():
        if isinstance(node, ast.ClassDef) and name != "SceneError":
            assert set(members(node)) == names(getattr(_swell, name)), name
            told |= {f"{name}.{method}": function for method, function in members(node).items()}
    assert len(told) > 15
    for name, function in told.items():
        there = _swell
        for part in name.split("."):
            there = getattr(there, part)
        assert stub_signature(function, aliases) == module_signature(there), name


def test_every_public_function_has_types():
    assert (PACKAGE / "py.typed").exists()
    count = 0
    for file in sorted(PACKAGE.glob("*.py")):
        scopes = [ast.parse(file.read_text())]
        scopes += [node for node in scopes[0].body if isinstance(node, ast.ClassDef) and not node.name.startswith("_")]
        for function in (node for scope in scopes for node in scope.body if isinstance(node, ast.FunctionDef)):
            if function.name.startswith("_") and function.name not in ("__init__", "__getitem__"):
                continue
            count += 1
            given = function.args.posonlyargs + function.args.args + function.args.kwonlyargs
            bare = [a.arg for a in given if a.annotation is None and a.arg not in ("self", "cls")]
            assert not bare, f"{file.name}: {function.name}: {bare}"
            assert function.returns or function.name == "__init__", f"{file.name}: {function.name}"
    assert count > 40
