"""`/sessions/{id}/frame`: one picture of the road, drawn without a screen."""

from __future__ import annotations

from fastapi import APIRouter

router = APIRouter(tags=["watching"])
