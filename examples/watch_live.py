"""Watches a running session. Start the service with `make run`, then: python examples/watch_live.py"""

import asyncio
import sys

from service.client import AsyncClient, Changed, Hello, Tick

url = sys.argv[1] if len(sys.argv) > 1 else "http://127.0.0.1:8000"
TICKS = 5


async def watch() -> None:
    """Prints what the vehicle does, and says something midway."""
    async with AsyncClient(url) as client:
        session = await client.create(seed=7)
        seen = 0
        async for message in session.watch():
            match message:
                case Hello():
                    print(f"Watching from tick {message.state.tick}.")
                case Tick():
                    print(f"Tick {message.tick}: {message.narration}")
                    seen += 1
                    if seen == 2:
                        await session.say("add five potholes")
                case Changed():
                    print(f"Changed: {message.reply}")
            if seen == TICKS:
                break
        await session.delete()


asyncio.run(watch())
