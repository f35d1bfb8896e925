"""Routes say what is special about them; what they do not say is guarded."""

from __future__ import annotations

import pytest
from fastapi import Response
from starlette.routing import Route

from service.http.middleware.direct_routes import DirectRoutes
from service.http.route import ApiRoute, GuardedRoute, api_router
from service.http.route_policy import RoutePolicy, policy
from service.http.session_json import PREFIX
from tests.contract.document import asked

OPEN = {"/", "/embed", "/docs", "/guide", "/openapi.json", "/healthz", "/readyz"}
"""Open to all, besides files."""


def test_every_route_but_pages_and_health_is_guarded() -> None:
    routes = [each for each in asked().routes if isinstance(each, Route)]
    guarded = {each.path for each in routes if isinstance(each, GuardedRoute)}
    assert {each.path for each in routes if each.path.startswith(PREFIX)} <= guarded
    assert "/metrics" in guarded
    assert guarded.isdisjoint(OPEN)
    files = {each.path for each in routes} - guarded - OPEN
    assert all(
        "{path:path}" in path or path.rpartition(".")[2] in ("js", "css", "svg", "json") for path in files
    )


async def test_a_route_has_the_policy_of_its_endpoint_and_the_ordinary_one_otherwise() -> None:
    router = api_router("talking")

    @router.get("/sessions/{session_id}/honks")
    @policy(entity_tag=False)
    async def list_honks(session_id: str) -> Response:
        return Response(session_id)

    @router.get("/honks")
    async def list_all_honks() -> Response:
        return Response()

    special, ordinary = router.routes
    assert isinstance(special, ApiRoute)
    assert isinstance(ordinary, ApiRoute)
    assert special.policy == RoutePolicy(entity_tag=False)
    assert ordinary.policy == RoutePolicy()
    assert (special.path, special.unique_id) == (f"{PREFIX}/sessions/{{session_id}}/honks", "list_honks")


def test_a_direct_route_takes_only_what_can_be_given_to_it() -> None:
    router = api_router("talking")

    @router.get("/sessions/{session_id}/honks")
    @policy(direct=True)
    async def list_honks(volume: int) -> Response:
        return Response(str(volume))

    with pytest.raises(TypeError, match="honks cannot be a direct route"):
        DirectRoutes(asked(), router.routes)
