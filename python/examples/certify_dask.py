"""A study on Dask: a worker that dies loses what it was at, which others run again.

    python certify_dask.py SCENE VARY.toml SAMPLES [SCHEDULER]
"""

import sys

import surefoot
from dask.distributed import Client, as_completed

CHUNK = 8


def run(study: surefoot.Study, samples: list[int]) -> list[surefoot.Row]:
    return study.run(samples, workers=1)


def certify(client: Client, study: surefoot.Study, samples: int) -> dict:
    chunks = [list(range(first, min(first + CHUNK, samples))) for first in range(0, samples, CHUNK)]
    # A chunk may be run twice, as its bits are the same; its rows are taken once.
    futures = client.map(run, [study] * len(chunks), chunks, pure=False, retries=5)
    rows = [row for _, found in as_completed(futures, with_results=True) for row in found]
    return study.certificate(rows, samples=samples)


if __name__ == "__main__":
    scene, vary, samples = sys.argv[1], sys.argv[2], int(sys.argv[3])
    with Client(*sys.argv[4:5]) as client:
        print(certify(client, surefoot.Study(scene, vary), samples)["failure_probability"])
