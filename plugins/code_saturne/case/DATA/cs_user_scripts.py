"""The case's mesh, its files, and the carom library to link (environment variable CAROM: where install.sh put it)."""

import os

CAROM = os.environ["CAROM"]


def define_domain_parameters(domain):
    domain.meshes = ["channel.msh"]
    domain.user_input_files = ["carom-walls.txt", "walls.toml"]
    domain.compile_cflags = "-I" + os.path.join(CAROM, "include")
    domain.compile_libs = os.path.join(CAROM, "lib", "libcarom.a")
    domain.n_procs_weight = None
