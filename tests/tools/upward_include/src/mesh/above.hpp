// Above core.
