"""The quiz "what will it do next, and why?": how well a person's picture of a planner predicts it.

A person predicts decisions before and after reading explanations of others (`situations`); the answers are
scored and written to a file together with two scales of opinion (`result`), which is what a study of
explanations needs. After Hoffman, Mueller, Klein & Litman, "Metrics for explainable AI" (2018; Frontiers in
Computer Science 5, 2023).
"""
