"""How notebooks show a session."""

from __future__ import annotations

from service.client.errors import RoadtalkError
from service.contract import notebook_html as html
from service.contract.state import State


class InNotebook:
    """A session that is shown as its road; what went wrong, if its state cannot be read."""

    def state(self, tick: int | None = None) -> State:
        """The world now, or at a past tick."""
        raise NotImplementedError

    def _repr_html_(self) -> str:
        try:
            return html.road(self.state())
        except RoadtalkError as error:
            return html.table(str(error), (), ())


class AsyncInNotebook:
    """A session that is shown by its id: notebooks await nothing while they show a value."""
