"""A study on Ray: a task whose worker dies is run again elsewhere.

    python certify_ray.py SCENE VARY.toml SAMPLES [ADDRESS]
"""

import sys

import ray
import surefoot

CHUNK = 8


@ray.remote(max_retries=5)
def run(study: surefoot.Study, samples: list[int]) -> list[surefoot.Row]:
    return study.run(samples, workers=1)


def certify(study: surefoot.Study, samples: int) -> dict:
    shared = ray.put(study)
    chunks = [list(range(first, min(first + CHUNK, samples))) for first in range(0, samples, CHUNK)]
    tasks = [run.remote(shared, chunk) for chunk in chunks]
    rows = [row for task in tasks for row in ray.get(task)]
    return study.certificate(rows, samples=samples)


if __name__ == "__main__":
    scene, vary, samples = sys.argv[1], sys.argv[2], int(sys.argv[3])
    ray.init(*sys.argv[4:5])
    print(certify(surefoot.Study(scene, vary), samples)["failure_probability"])
