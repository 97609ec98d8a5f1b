"""Names for results that are kept: a run is not made again while everything that decides it is the same."""
import hashlib


def key_of(*paths):
    """Hash of the bytes of programs and files, and of all files in folders."""
    digest = hashlib.sha256()
    for path in paths:
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.is_file():
                digest.update(file.name.encode())
                digest.update(file.read_bytes())
    return digest.hexdigest()[:16]
