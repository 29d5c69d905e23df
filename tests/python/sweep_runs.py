"""What tests let sweeps do in their workers, which need functions of a module. The scene's title is a folder for marks."""
import os
import pathlib
import signal

import numpy as np

import pliant


def count(simulation):
    """Leaves a file for each call, beside the scene's table."""
    folder = pathlib.Path(simulation.scene.title)
    (folder / f"call-{os.getpid()}-{len(list(folder.glob('call-*')))}").touch()
    simulation.advance(5)
    return {"x": simulation.positions[0, 0], "note": "1e5", "list": [1, 2.5], "pid": None}


def die_once(simulation):
    """The first call that meets this stiffness ends its process, as a crash or a lack of memory would."""
    mark = pathlib.Path(simulation.scene.title) / "died"
    if simulation.bodies["left"].stiffness == 20 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return pliant.run_to_end(simulation)


def die_always(simulation):
    if simulation.bodies["left"].stiffness == 20:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"steps": simulation.steps}


def fail_at_first(simulation):
    mark = pathlib.Path(simulation.scene.title) / "failed"
    if simulation.bodies["left"].stiffness == 20 and not mark.exists():
        mark.touch()
        raise ValueError("not yet")
    return {"steps": simulation.steps}


def die_while_others_run(simulation):
    """One run ends its process while another is in the midst of its own. They meet at a pipe, which opens once both are there."""
    folder = pathlib.Path(simulation.scene.title)
    died, is_culprit = folder / "died", simulation.bodies["left"].stiffness == 20
    if not died.exists():
        with open(folder / "pipe", "r" if is_culprit else "w"):
            pass
        if not is_culprit:
            signal.pause()  # until its pool has broken
        died.touch()
    if is_culprit:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"steps": simulation.steps}


def return_odd_values(simulation):
    return {"set": {1, 2}}


def return_numpys_values(simulation):
    return {"number": np.float64(0.1), "numbers": np.array([1, 2]), "text": "true", "nothing": None, "empty": ""}


def return_what_is_taken(simulation):
    return {"body.left.stiffness": 99, "key": 1, "steps": 2}


def tell_and_wait(simulation):
    (pathlib.Path(simulation.scene.title) / f"pid-{os.getpid()}").touch()
    signal.pause()
    return {}
