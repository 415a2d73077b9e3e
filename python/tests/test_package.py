"""Stubs, docstrings and examples: what is promised is there."""

import ast
import inspect
import pathlib
import re
import subprocess
import sys

import pytest

import openflank

ROOT = pathlib.Path(__file__).resolve().parents[2]
STUB = ast.parse((ROOT / "python/openflank/__init__.pyi").read_text())
CLASSES = {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}
FUNCTIONS = {node.name: node for node in STUB.body if isinstance(node, ast.FunctionDef)}


def public(names):
    return {name for name in names if not name.startswith("_")}


def arguments(function):
    every = function.args
    rest = [every.kwarg] if every.kwarg else []
    return [a.arg for a in every.posonlyargs + every.args + every.kwonlyargs + rest if a.arg != "self"]


def told_arguments(doc):
    """Those of the first signature in a docstring that pybind11 made."""
    inside = re.match(r"\w+\((.*)\) ->", doc).group(1)
    return [name for name in re.findall(r"(\w+): ", inside) if name != "self"]


def test_the_stub_has_every_name():
    assert set(CLASSES) | set(FUNCTIONS) == set(openflank.__all__)


@pytest.mark.parametrize("name", sorted(CLASSES))
def test_the_stub_of_a_class_is_the_class(name):
    thing = getattr(openflank, name)
    own = {n for n in vars(thing)} if not issubclass(thing, BaseException) else {n for n in vars(thing) if n != "args"}
    stubbed = {node.name: node for node in CLASSES[name].body if isinstance(node, ast.FunctionDef)}
    fields = {node.target.id for node in CLASSES[name].body if isinstance(node, ast.AnnAssign)}
    if issubclass(thing, BaseException):
        assert fields <= {"field", "result"} and thing.__doc__
        return
    assert public(stubbed) == public(own)
    for member in public(own):
        value = inspect.getattr_static(thing, member)
        assert value.__doc__, f"{name}.{member} has no docstring"
        is_property = any(getattr(d, "id", "") == "property" for d in stubbed[member].decorator_list)
        assert is_property == isinstance(value, property), member
        if inspect.isfunction(value):
            assert arguments(stubbed[member]) == list(inspect.signature(value).parameters)[1:]
        elif not is_property:
            assert arguments(stubbed[member]) == told_arguments(getattr(thing, member).__doc__), member


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_the_stub_of_a_function_is_the_function(name):
    function = getattr(openflank, name)
    assert function.__doc__
    if inspect.isbuiltin(function):
        assert arguments(FUNCTIONS[name]) == told_arguments(function.__doc__)
    else:
        assert arguments(FUNCTIONS[name]) == list(inspect.signature(function).parameters)


def test_stubs_are_those_of_the_table_of_fields():
    done = subprocess.run([sys.executable, ROOT / "scripts/python_stubs.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_arrays_say_their_shape_and_lengths_their_unit():
    for name, node in CLASSES.items():
        for member in node.body:
            if not isinstance(member, ast.FunctionDef) or "_Doubles" not in ast.unparse(member.returns or ast.Constant(0)):
                continue
            doc = inspect.getattr_static(getattr(openflank, name), member.name).__doc__
            assert re.search(r"\w x \w|\(\w*,\)|\(\d,\)|shape of|\(n,\)|Area of each bin|Edges of the bins|knots|\(n_u|\(n_v", doc), f"{name}.{member.name}: {doc}"


def readme_example():
    return re.search(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL).group(1)


def test_the_example_of_the_readme_runs(blade, tmp_path):
    code = readme_example()
    assert len(code.strip().splitlines()) <= 10
    (tmp_path / "blade.step").write_bytes(blade.read_bytes())
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out" / "report.html").is_file()


def test_mypy_accepts_the_examples_and_finds_faults(tmp_path):
    pytest.importorskip("mypy")
    (tmp_path / "readme.py").write_text(readme_example())
    (tmp_path / "wrong.py").write_text("import openflank\nopenflank.fit('blade.step', tolerance='wide', tolerance_mm='wide')\n")
    examples = [str(file) for file in sorted((ROOT / "examples").glob("*.py"))]
    config = ["--config-file", str(ROOT / "python/mypy.ini"), "--cache-dir", str(tmp_path / "cache")]
    good = subprocess.run([sys.executable, "-m", "mypy", *config, str(tmp_path / "readme.py"), *examples], capture_output=True, text=True)
    assert good.returncode == 0, good.stdout
    wrong = subprocess.run([sys.executable, "-m", "mypy", *config, str(tmp_path / "wrong.py")], capture_output=True, text=True)
    assert 'Unexpected keyword argument "tolerance"' in wrong.stdout and '"tolerance_mm"' in wrong.stdout
