"""Keywords come from the library's table; errors, progress and Ctrl-C."""

import inspect
import json
import os
import signal
import subprocess
import threading
import time

import pytest

import openflank

COMMANDS = ("fit", "cover", "trochoid", "verify", "post")


@pytest.mark.parametrize("command", COMMANDS)
def test_keywords_are_the_fields_of_the_table(command):
    function = getattr(openflank, command)
    names = set(inspect.signature(function).parameters) - {"progress"}
    fields = openflank.job_fields(command)
    assert names == {field.name for field in fields}
    for field in fields:
        assert field.help and f"\n{field.name}\n" in function.__doc__
    with pytest.raises(openflank.UsageError, match="must be fit, cover"):
        openflank.job_fields("sing")


def test_defaults_are_those_of_the_table():
    parameters = inspect.signature(openflank.fit).parameters
    assert parameters["tolerance_mm"].default is None
    assert parameters["turn_max"].default == 15.0 and isinstance(parameters["turn_max"].default, float)
    assert parameters["strips"].default == "auto"
    assert parameters["avoid"].default is True
    assert parameters["axis_length_mm"].default is None
    assert parameters["part"].default is inspect.Parameter.empty
    assert list(inspect.signature(openflank.cover).parameters)[:2] == ["part", "tool"]
    assert list(inspect.signature(openflank.verify).parameters)[:1] == ["folder"]


def test_wrong_requests_name_the_keyword(blade):
    with pytest.raises(openflank.UsageError, match="tolerance_mm -1: expected a length > 0 mm") as caught:
        openflank.fit(blade, tolerance_mm=-1)
    assert caught.value.field == "tolerance_mm"
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, openflank.Error)
    with pytest.raises(openflank.UsageError, match="tolerence_mm: is not a field of fit; did you mean tolerance_mm; expected part, "):
        openflank.fit(blade, tolerence_mm=0.1)
    with pytest.raises(openflank.UsageError, match="did you mean tolerance_mm"):
        openflank.fit(blade, tolerance=0.1)
    with pytest.raises(openflank.UsageError, match="colour: is not a field of fit; expected part, "):
        openflank.fit(blade, colour="red")
    with pytest.raises(openflank.UsageError, match="strips"):
        openflank.fit(blade, strips=0)
    with pytest.raises(TypeError, match="avoid: expected True or False"):
        openflank.fit(blade, avoid="maybe" and 1)
    with pytest.raises(TypeError, match="needs part"):
        openflank.fit()
    with pytest.raises(TypeError, match="part twice"):
        openflank.fit(blade, part=blade)


def test_refused_input_names_the_file(blade, tmp_path):
    with pytest.raises(openflank.InputError, match="nothing.step"):
        openflank.fit(tmp_path / "nothing.step")
    with pytest.raises(openflank.InputError, match="F7"):
        openflank.fit(blade, faces="F7")
    with pytest.raises(openflank.InputError) as caught:
        openflank.report(tmp_path / "nothing")
    assert not isinstance(caught.value, openflank.UsageError)


def test_faces_may_be_a_list_and_the_part_one_that_was_read(blade):
    part = openflank.read_part(blade)
    with pytest.raises(openflank.InputError, match="F8"):
        openflank.fit(part, faces=["F1", "F8"])


def test_progress_is_told(blade):
    told = []
    result = openflank.fit(blade, side="+", tolerance_mm=0.1, progress=lambda stage, share: told.append((stage, share)))
    assert result.complete and len(told) > 3
    assert all(isinstance(stage, str) and 0.0 <= share <= 1.0 for stage, share in told)
    assert len({share for _, share in told}) > 2


def test_what_progress_raises_ends_the_work(blade):
    class Enough(Exception):
        pass

    calls = []

    def raise_enough(stage, share):
        calls.append(stage)
        raise Enough(stage)

    with pytest.raises(Enough):
        openflank.fit(blade, tolerance_mm=0.1, progress=raise_enough)
    assert len(calls) == 1


def test_ctrl_c_stops_and_leaves_the_best_so_far(blade, tmp_path):
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(openflank.Interrupted) as caught:
        openflank.fit(blade, tolerance_mm=0.001)
    timer.join()
    assert isinstance(caught.value, KeyboardInterrupt)
    result = caught.value.result
    assert not result.complete and not result.passed
    assert ("complete" in dict(result.reasons)), result.reasons
    result.write(tmp_path / "out")
    assert (tmp_path / "out" / "tool.json").is_file()


def test_other_threads_run_meanwhile(blade):
    stop, longest = threading.Event(), [0.0]

    def watch():
        last = time.monotonic()
        while not stop.is_set():
            time.sleep(0.001)
            now = time.monotonic()
            longest[0], last = max(longest[0], now - last), now

    watcher = threading.Thread(target=watch)
    watcher.start()
    begin = time.monotonic()
    openflank.fit(blade, side="+", tolerance_mm=0.1)
    took = time.monotonic() - begin
    stop.set()
    watcher.join()
    assert longest[0] < 0.5 * took, (longest, took)


def test_what_only_looks_says_what_the_command_says(tmp_path):
    def said(*words):
        done = subprocess.run([os.environ["FLANK_BINARY"], *words], capture_output=True, text=True, check=True)
        return json.loads(done.stdout)

    file = tmp_path / "impeller.step"
    assert openflank.example("impeller", file)["files"] == [str(file)]
    assert "impeller" in openflank.examples()
    assert openflank.inspect(file, sort="area") == said("inspect", str(file), "--sort", "area", "--json")
    flat = openflank.inspect(openflank.read_part(file), type="plane")["faces"]
    assert flat and all(row["type"] == "plane" for row in flat)
    assert {"machines": openflank.machines()}.items() <= said("machine", "--list", "--json").items()
    name = openflank.machines()[0]["name"]
    assert openflank.machine(name) == said("machine", name, "--json")
    with pytest.raises(openflank.UsageError, match="impellor"):
        openflank.example("impellor", file)


def test_what_is_no_wheel_is_refused_and_says_what_is_missing(blade, tmp_path):
    with pytest.raises(openflank.InputError, match="revolution|axis|blade"):
        openflank.wheel(blade, tmp_path / "out")
    with pytest.raises(openflank.UsageError, match="tolerance"):
        openflank.wheel(blade, tmp_path / "out", tolerance_mm=0.0)
