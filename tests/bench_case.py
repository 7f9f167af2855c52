"""What the tests of clucida-bench share: a scene of glass in a folder of its own."""

import os
import tempfile

SCENE = """clucida 1
observer { eye [0, -6, 2]; look [0, 0, 0.8]; fov 45 }
sky gradient { low 0.2; middle 0.8; high [0.2, 0.4, 1] }
light { point [5, -5, 8] }
optics glass { reflection 0.1; refraction 0.9; index 1.5 }
object ball { solid sphere([0, 0, 1], 1); optics glass }
object ground { solid plane([0, 0, 0], [0, 0, 1]); optics { absorption 0.5 } }
"""


def glass_scene(test):
    """The folder, which goes with the test, and the scene's file in it."""
    folder = tempfile.TemporaryDirectory()
    test.addCleanup(folder.cleanup)
    scene = os.path.join(folder.name, "glass.clu")
    with open(scene, "w") as file:
        file.write(SCENE)
    return folder, scene
