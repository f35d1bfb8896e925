"""How notebooks show a session: as a drawing of its road, and with the extra `notebook` as a widget.

Leaves out the widget itself (`session_widget`), which needs anywidget and is imported when wanted.
"""

from __future__ import annotations

import sys
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from service.client.errors import RoadtalkError
from service.contract import notebook_html as html
from service.contract.state import State

if TYPE_CHECKING:
    from service.client.async_client import AsyncClient
    from service.client.session_widget import SessionWidget
    from service.client.sync_client import Client

WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"
MISSING = "To play, step and ask here: pip install 'roadtalk[notebook]'"


class WidgetMissingError(RoadtalkError):
    """The extra `notebook` is not installed."""

    def __init__(self) -> None:
        super().__init__("A session's widget needs the extra 'notebook': pip install 'roadtalk[notebook]'")


def has_widget() -> bool:
    """Whether the extra `notebook` is installed."""
    return find_spec("anywidget") is not None


class WithWidget:
    """A session that can be shown as a widget, whatever client it belongs to."""

    id: str
    _widget: SessionWidget | None = None

    def _opened_by(self) -> Client | AsyncClient:
        """The client that the session belongs to."""
        raise NotImplementedError

    def widget(self, *, language: str | None = None) -> SessionWidget:
        """The session in a notebook: its road as it moves, with play, step and a line to say and ask.

        All of its views in a notebook are one widget, which has a connection of its own until it is closed
        (`widget().close()`). Raises `WidgetMissingError` without the extra `notebook`.
        """
        if not has_widget():
            raise WidgetMissingError
        from service.client.session_widget import SessionWidget

        if self._widget is None or self._widget.closed:
            self._widget = SessionWidget(_second_client(self._opened_by()), self.id)
        if language is not None:
            self._widget.language = language
        return self._widget

    def _repr_mimebundle_(self, **_: Any) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The widget beside the other forms, where a notebook asks and the extra is installed."""
        shown = self.widget()._repr_mimebundle_() if has_widget() and _in_notebook() else None
        if shown is None:
            return None
        forms, about = shown
        return {WIDGET_VIEW: forms[WIDGET_VIEW]}, about


class InNotebook(WithWidget):
    """A session that is shown as its road; what went wrong, if its state cannot be read."""

    def state(self, tick: int | None = None) -> State:
        """The world now, or at a past tick."""
        raise NotImplementedError

    def _repr_html_(self) -> str:
        try:
            drawn = html.road(self.state())
        except RoadtalkError as error:
            return html.table(str(error), (), ())
        return drawn if has_widget() else drawn + html.note(MISSING)


class AsyncInNotebook(WithWidget):
    """A session that is shown by its id without the widget: notebooks await nothing to show a value."""


def _second_client(client: Client | AsyncClient) -> AsyncClient:
    """Another client of the same service with the same key, for a loop of its own."""
    from service.client.async_client import AsyncClient

    return AsyncClient(client.url, api_key=client._api_key)


def _in_notebook() -> bool:
    """Whether the program is run by a kernel; a terminal shows text."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return getattr(shell, "kernel", None) is not None
