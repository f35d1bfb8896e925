"""A session by script. Start the service with `make run`, then: python examples/first_steps.py"""

import sys

from service.client import Ambiguous, Client, NotUnderstood

url = sys.argv[1] if len(sys.argv) > 1 else "http://127.0.0.1:8000"

with Client(url) as client:
    # The seed determines the road; `paused` leaves the clock to us.
    session = client.create(seed=11, config={"vehicles": 30}, paused=True)

    # Sentences.
    print(session.say("add five potholes").reply)
    print(session.say("advance three ticks").reply)

    # Typed actions: what a sentence becomes.
    print(session.act({"do": "remove", "kind": "pothole", "count": 2}).reply)

    # Questions. Every answer is proved.
    print(session.ask("why did you do that?").text)
    print(session.ask("what will you do next?").text)

    # What is not understood, or could mean two things, changes nothing.
    try:
        session.say("add five potholes and order pizza")
    except NotUnderstood as refused:
        print(refused)
    try:
        session.say("slower")
    except Ambiguous as unclear:
        print("Choices:", [choice.text for choice in unclear.choices])

    state = session.state()
    print(f"Tick {state.tick}, {state.count('pothole')} potholes, {state.count('vehicle')} cars.")
    session.delete()
