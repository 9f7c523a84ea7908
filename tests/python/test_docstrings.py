"""The examples in the docstrings do what they say, and everything that the package offers has one."""

import doctest
import importlib

import numpy as np
import pytest

import jostle

MODULES = ("bodies", "contact", "displacements", "lcp", "run", "scene", "simulation", "statistics", "stress", "structure", "sweeps",
           "threads")


@pytest.mark.parametrize("name", MODULES)
def test_examples_of(name):
    module = importlib.import_module(f"jostle.{name}")
    found = doctest.testmod(module, extraglobs={"np": np})
    assert found.attempted > 0
    assert found.failed == 0


@pytest.mark.parametrize("name", sorted(set(jostle.__all__) - {"Average", "ContactStress", "DiskError", "LcpResult", "PairStress", "Recording",
                                                               "Run", "StepFailure", "StepReport", "Sweep", "InputError", "analysis"}))
def test_has_an_example(name):
    offered = getattr(jostle, name)
    assert offered.__doc__
    assert ">>>" in offered.__doc__
