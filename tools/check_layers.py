#!/usr/bin/env python3
"""Fails when an include goes upward: a module uses itself and what stands before it in LAYERS.

usage: tools/check_layers.py [REPOSITORY]
"""
import pathlib
import re
import sys

# The order of docs/architecture.md. A folder of shaders counts as a module: both languages include from there.
LAYERS = ["core", "ranks", "mesh", "scene", "physics", "model", "gl", "kernels", "device", "state", "dynamics", "collision",
          "simulation", "render", "output", "run", "view", "window", "bench", "python", "app"]
GL_MODULES = ("gl", "device/gpu", "render")  # the only ones that see OpenGL's types
WINDOW_FILE = "src/window/window.cpp"  # the only one that sees GLFW
PANEL_FILES = [f"src/window/{name}.cpp" for name in ("panel", "start_page", "style")]  # the only ones that see Dear ImGui
SUFFIXES = {".hpp", ".cpp", ".inc", ".glsl", ".comp", ".vert", ".frag"}
INCLUDE = re.compile(r'^\s*#\s*include\s+(["<])([^">]+)[">]')


def module_of(path, root):
    """Returns the module of a file in the repository, or None outside of src/ and shaders/."""
    for folder in ("src", "shaders/compute", "shaders"):
        base = root / folder
        if path.is_relative_to(base):
            parts = path.relative_to(base).parts
            return parts[0] if len(parts) > 1 else "kernels"  # files beside the folders stand with the kernels
    return None


def resolve(name, including, root):
    """Returns the file in the repository that an include names, or None."""
    for folder in (including.parent, root / "src", root / "shaders" / "compute"):
        if (folder / name).is_file():
            return (folder / name).resolve()
    return None


def problem_of(path, name, root):
    """Returns what is wrong with file `path` including `name`, or None if nothing is."""
    module = module_of(path, root)
    if name.startswith("GLFW/"):
        return None if path == root / WINDOW_FILE else f"GLFW's headers belong in {WINDOW_FILE} alone"
    if name.startswith(("imgui", "backends/imgui")):
        inside = path in [root / file for file in PANEL_FILES]
        return None if inside else f"Dear ImGui's headers belong in {', '.join(PANEL_FILES)} alone"
    if name.startswith(("glad/", "GL/", "EGL/")):
        inside = any(path.is_relative_to(root / "src" / allowed) for allowed in GL_MODULES)
        return None if inside else f"OpenGL's headers belong in {', '.join(GL_MODULES)} alone"
    included = resolve(name, path, root)
    target = module_of(included, root) if included else None
    if target is None or LAYERS.index(target) <= LAYERS.index(module):
        return None
    return f"{module} may not include {target}, which stands above it"


def check(root):
    problems = []
    for path in sorted((root / "src").rglob("*")) + sorted((root / "shaders").rglob("*")):
        if path.suffix not in SUFFIXES:
            continue
        if module_of(path, root) not in LAYERS:
            problems.append(f"{path}:1: the module is missing in LAYERS of tools/check_layers.py")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            problem = match and problem_of(path, match[2], root)
            if problem:
                problems.append(f"{path}:{number}: {problem}")
    return problems


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    problems = check(root)
    print("\n".join(problems) or "includes go downward only")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
