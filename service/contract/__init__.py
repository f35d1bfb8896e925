"""The contract of the service: what it answers, what it accepts, and how both look in JSON.

`answers` names every answer: a frozen dataclass that the OpenAPI document, the stream's schema (`python -m
service.contract.schema`) and the client share. `requests` and `stream_requests` have what callers send,
`stream` the messages of a stream, `encode` the JSON of worlds and decisions. A new key of an answer is a
field of its dataclass, with its documentation on the next line, and a key where the answer is made; tests
compare the two.
"""
