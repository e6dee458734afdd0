"""Calls by workers that die, lack something or vanish: tried again elsewhere, then reported in words."""

from __future__ import annotations

from concurrent.futures import Future
from typing import Any

import pytest

import gbnbench
from gbnbench.core.errors import DeviceError, InputError, UnfinishedError
from gbnbench.execution import calls as calls_module
from gbnbench.execution.calls import Calls
from gbnbench.execution.remote_call import Answer, answered, packed

BAD_WORKER, GOOD_WORKER = "bad", "good"


class Scripted:
    """Workers that answer as a script says: an answer, an exception, or "cancelled", for each try in turn."""

    count = 2

    def __init__(self, *script: Any) -> None:
        self.script, self.avoided, self.gone = list(script), [], ""

    def submit(self, fn: Any, /, *args: Any) -> Future[Any]:
        future: Future[Any] = Future()
        step = self.script.pop(0) if self.script else fn(*args)
        if step == "cancelled":
            future.cancel()
            future.set_running_or_notify_cancel()
        elif step == "never":
            pass
        elif isinstance(step, Exception):
            future.set_exception(step)
        else:
            future.set_result(step)
        return future

    def shutdown(self) -> None: ...

    def trouble(self) -> str:
        return self.gone

    def avoid(self, worker: str) -> bool:
        self.avoided.append(worker)
        return worker != GOOD_WORKER


@pytest.mark.parametrize(
    "loss", [RuntimeError("killed by SIGKILL"), "cancelled", Answer(failure="not enough memory", again=True)]
)
def test_a_lost_worker_costs_a_try_and_no_result(loss: Any) -> None:
    calls = Calls(Scripted(loss, loss), tries=3)
    calls.submit("a", abs, -2)
    assert calls.next().value == 2
    assert calls.pending == 0
    calls = Calls(Scripted(loss, loss), tries=2)
    calls.submit("a", abs, -2)
    assert calls.next().failure in ("killed by SIGKILL", "its worker was lost", "not enough memory")
    assert calls.pending == 0


def refused() -> None:
    raise InputError("n must be even; got 13")


def test_a_refusal_is_reported_at_once_and_the_unforeseen_tried_again() -> None:
    workers = Scripted()
    calls = Calls(workers, tries=3)
    calls.submit("a", refused)
    assert calls.next().failure == "n must be even; got 13"
    answer = answered(gbnbench.__version__, b"", packed(divmod, 1, 0))
    assert "ZeroDivisionError" in answer.failure
    assert answer.again
    assert not answer.unfit


def test_a_worker_that_cannot_serve_is_avoided_and_named_once() -> None:
    unfit = Answer(failure="it has no OpenCL device", again=True, unfit=True, worker=BAD_WORKER)
    workers = Scripted(unfit, unfit)
    calls = Calls(workers, tries=3)
    calls.submit("a", abs, -2)
    assert calls.next().value == 2
    assert workers.avoided == [BAD_WORKER, BAD_WORKER]
    assert calls.left_out == ["it has no OpenCL device"]
    calls = Calls(Scripted(Answer(failure="no device", again=True, unfit=True, worker=GOOD_WORKER)))
    calls.submit("a", abs, -2)
    with pytest.raises(UnfinishedError, match="no worker can serve: no device"):
        calls.next()


def test_trouble_ends_the_wait(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(calls_module, "POLL_SECONDS", 0.01)
    workers = Scripted("never")
    calls = Calls(workers)
    calls.submit("a", abs, -2)
    workers.gone = "the scheduler is gone"
    with pytest.raises(UnfinishedError, match="the scheduler is gone"):
        calls.next()


def lacking() -> str:
    raise DeviceError("none here")


def unfit_always() -> str:
    return "this one cannot"


def test_a_worker_answers_another_version_and_a_failed_check_in_words(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    call = packed(abs, -3)
    assert answered(gbnbench.__version__, b"", call) == Answer(3)
    assert answered(gbnbench.__version__, packed(unfit_always), call).failure == "this one cannot"
    assert answered(gbnbench.__version__, b"", packed(lacking)) == Answer(failure="none here", again=True)
    other = answered("9.9", b"not even a pickle", b"neither")
    assert other.unfit
    assert f"has gbnbench {gbnbench.__version__}, and this run is made by 9.9" in other.failure
