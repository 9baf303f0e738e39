"""Two spheres of a law's material collide in YADE, with the forces of the law: yade -n -x in_yade.py law.h5 powder 1e-3 2.0

The words are the law file, the material, the radius (m) and the speed (m/s).

YADE finds the contacts, by a law of its own that is nearly zero, and moves the bodies. In each step all contacts are advanced in one
call, and their forces added. The contacts' memory is kept by the ids of the two bodies. Walls and facets are not covered.
"""
import sys

import granulaw
import numpy as np

NOTHING = 1e-9  # Pa, of YADE's own law


class LawInYade:
    def __init__(self, contact):
        self.contact, self.kept = contact, {}

    def __call__(self):
        found = [i for i in O.interactions if i.isReal]
        motion, history = self.contact.motion(len(found)), self.contact.history(len(found))
        for k, i in enumerate(found):
            a, b = O.bodies[i.id1], O.bodies[i.id2]
            normal, overlap = -np.array(i.geom.normal), i.geom.penetrationDepth  # from b to a
            arm_a, arm_b = a.shape.radius - overlap / 2, b.shape.radius - overlap / 2
            velocity = np.array(a.state.vel - b.state.vel) - np.cross(arm_a * np.array(a.state.angVel) + arm_b * np.array(b.state.angVel), normal)
            approach = -velocity @ normal
            motion[k]["radius_a"], motion[k]["radius_b"] = a.shape.radius, b.shape.radius
            motion[k]["m_eff"] = a.state.mass * b.state.mass / (a.state.mass + b.state.mass)
            motion[k]["overlap"], motion[k]["approach"], motion[k]["dt"] = overlap, approach, O.dt
            motion[k]["normal"], motion[k]["slide"] = normal, velocity + approach * normal
            history[k] = self.kept.get((i.id1, i.id2), 0)
        if not found:
            return
        answer = self.contact.advance(motion, history)
        self.kept = {(i.id1, i.id2): history[k] for k, i in enumerate(found)}
        for i, m, f in zip(found, motion, answer):
            force = f["normal"] * m["normal"] + f["shear"]
            for id, sign, radius in ((i.id1, 1, m["radius_a"]), (i.id2, -1, m["radius_b"])):
                O.forces.addF(id, Vector3(*(sign * force)))
                O.forces.addT(id, Vector3(*(-(radius - m["overlap"] / 2) * np.cross(m["normal"], force))))


file, name, radius, speed = sys.argv[-4], sys.argv[-3], float(sys.argv[-2]), float(sys.argv[-1])
law = granulaw.read(file)
impact = law.pair(f"{name}:{name}", radius=radius).impact(speed)
O.materials.append(FrictMat(young=NOTHING, poisson=0.3, frictionAngle=0, density=law.materials[name].density))
for z, v in ((-1.0001 * radius, speed / 2), (1.0001 * radius, -speed / 2)):
    O.bodies.append(sphere((0, 0, z), radius))
    O.bodies[-1].state.vel = (0, 0, v)
advance = LawInYade(law.contact(f"{name}:{name}", elastic_damping=0))  # as mpm law has it
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    PyRunner(command="advance()", iterPeriod=1),
    NewtonIntegrator(damping=0),
]
O.dt = impact["contact_time_s"] / 2000
O.run(int(1.2 * 2000 + 2e-4 * radius / speed / O.dt), wait=True)
e = (O.bodies[1].state.vel[2] - O.bodies[0].state.vel[2]) / speed
print(f"e {e:.6f} in YADE, {impact['e']:.6f} by mpm law")
