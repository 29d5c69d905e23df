"""What tests let sweeps do in their workers, which need functions of a module. The scene's title is a folder for marks."""
import os
import pathlib
import signal

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
