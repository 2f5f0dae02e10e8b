from pathlib import Path

import numpy as np
import pytest
import surefoot

# A pendulum: a rod of mass m whose centre is l from its hinge, with an inertia about that centre.
M, L, I, G = 1.5, 0.4, 0.07, 9.80665
URDF = f"""<robot name="pendulum">
<link name="world"/>
<joint name="hinge" type="continuous"><parent link="world"/><child link="rod"/><axis xyz="0 1 0"/></joint>
<link name="rod"><inertial><origin xyz="0 0 {-L}"/><mass value="{M}"/>
<inertia ixx="{I}" iyy="{I}" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
</robot>"""


@pytest.fixture
def pendulum(tmp_path: Path) -> surefoot.Robot:
    path = tmp_path / "pendulum.urdf"
    path.write_text(URDF)
    return surefoot.Robot(path)


def test_a_pendulum_has_its_closed_form(pendulum):
    q = np.linspace(-3.0, 3.0, 25)[:, None]
    v = np.full_like(q, 0.7)
    found = pendulum.dynamics(q, v, tau=np.full_like(q, 0.2))
    inertia = I + M * L * L
    gravity = found["inverse"][np.argmax(q)][0] / np.sin(q.max()) / (M * L)
    assert gravity == pytest.approx(G, rel=1e-3)
    np.testing.assert_allclose(found["mass_matrix"][:, 0, 0], inertia, rtol=1e-12)
    np.testing.assert_allclose(found["inverse"], M * gravity * L * np.sin(q), atol=1e-12)
    np.testing.assert_allclose(found["forward"], (0.2 - M * gravity * L * np.sin(q)) / inertia, rtol=1e-11, atol=1e-11)
    assert found["link_positions"].shape == (25, 1, 3)


def test_inverse_and_forward_dynamics_are_inverse(pendulum):
    q, v, tau = pendulum.home() + 0.3, np.array([1.1]), np.array([0.4])
    a = pendulum.dynamics(q, v, tau=tau)["forward"]
    np.testing.assert_allclose(pendulum.dynamics(q, v, a=a)["inverse"], tau, rtol=1e-12)


def test_wrong_input_is_told(pendulum, tmp_path):
    assert (pendulum.nq, pendulum.nv, pendulum.joints, pendulum.links) == (1, 1, ["hinge"], ["rod"])
    with pytest.raises(ValueError, match="q: 2 numbers; expected 1"):
        pendulum.dynamics([0.0, 0.0])
    with pytest.raises(ValueError, match="expected mujoco or pinocchio"):
        surefoot.Robot(tmp_path / "pendulum.urdf", convention="other")
    with pytest.raises(ValueError, match="none.urdf"):
        surefoot.Robot(tmp_path / "none.urdf")
