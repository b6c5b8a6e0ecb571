"""Real meshes for the tests: those of Debian's package libcgal-demo, and a corpus where one is there.

`path` gives a mesh's file by its name, for taut and its peers to read each by itself.
"""

import functools
import gzip
import os
import pathlib
import tarfile
import tempfile

ARCHIVE = pathlib.Path("/usr/share/doc/libcgal-dev/data.tar.gz")
CORPUS = pathlib.Path(os.environ.get("TAUT_CORPUS", pathlib.Path(__file__).parents[4] / "shared/meshes"))


@functools.lru_cache(maxsize=None)
def _folder():
    """A temporary folder, there until the tests end."""
    return tempfile.TemporaryDirectory()


@functools.lru_cache(maxsize=None)
def path(name):
    """The file of a mesh: "fandisk.off" of the archive, "corpus/lucy.obj.gz" of the corpus, unpacked."""
    unpacked = pathlib.Path(_folder().name) / name.replace("/", "-").removesuffix(".gz")
    if name.startswith("corpus/"):
        packed = CORPUS / name.removeprefix("corpus/")
        if packed.suffix != ".gz":
            return packed
        unpacked.write_bytes(gzip.decompress(packed.read_bytes()))
    else:
        with tarfile.open(ARCHIVE) as archive:
            unpacked.write_bytes(archive.extractfile(f"data/meshes/{name}").read())
    return unpacked
