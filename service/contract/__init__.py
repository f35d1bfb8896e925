"""The models of requests and answers, shared by the service and its client, and their JSON encoders."""
