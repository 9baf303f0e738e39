/* Two bodies thrown at each other, head-on, by a law file, from C:
 *
 *     m* d(v)/dt = -F(delta),   d(delta)/dt = v,   v(0) = V,   until F ends.
 *
 *     cc collide.c -o collide -lgranulaw -lm           (-I and -L of the folder where the package was put)
 *     mpm law powder.h5 --pair powder:wall --radius 1e-3 --velocity 2     for its m* and e
 *     ./collide powder.h5 powder wall 1e-3 inf 6.283185307e-6 2
 *
 * Arguments: the file, both materials, both radii (m; inf: a wall), m* (kg), V (m/s). Prints e, the largest force
 * (N), the largest overlap (m) and the parts of m* V^2/2 that plastic flow and waves took. Velocity Verlet, as a
 * particle code has it, with as many steps as `mpm law` takes.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "granulaw.h"

int main(int argc, char **argv)
{
  if (argc != 8) {
    fprintf(stderr, "collide LAW A B RADIUS_A RADIUS_B EFFECTIVE_MASS VELOCITY\n");
    return 2;
  }
  const double radius = atof(argv[4]), partner = atof(argv[5]), mass = atof(argv[6]), velocity = atof(argv[7]);
  granulaw_pair pair;
  granulaw_usual_pair(&pair, sizeof pair);
  pair.a = argv[2], pair.b = argv[3];
  pair.radius_a = radius, pair.radius_b = partner;
  pair.elastic_damping = 0; /* the law alone, as `mpm law` has it */

  granulaw_law *law;
  granulaw_contact_law *contact;
  granulaw_why why;
  if (granulaw_open(argv[1], &law, &why) || granulaw_contact(law, &pair, &contact, &why)) {
    fprintf(stderr, "collide: %s\n", why.text);
    return 1;
  }
  granulaw_close(law); /* the contact's law stays */
  double *history = calloc(granulaw_history(contact), sizeof *history);
  double ledger[GRANULAW_MECHANISMS] = {0};

  granulaw_motion m = {0};
  granulaw_answer now = {0};
  granulaw_state state = {0};
  m.size = sizeof m, now.size = sizeof now, state.size = sizeof state;
  m.radius_a = radius, m.radius_b = partner;
  m.m_eff = mass;
  m.normal[2] = 1;
  const double r_eff = isinf(partner) ? radius : radius * partner / (radius + partner);
  /* the step: Hertz's time of contact over 20000, E* by the stiffness of a tiny overlap */
  m.overlap = 1e-12 * r_eff;
  if (granulaw_state_of(contact, 1, &m, history, &state)) {
    fprintf(stderr, "collide: the mass is over 0\n");
    return 1;
  }
  m.overlap = 0;
  const double e_star = state.stiffness / (2 * 1e-6 * r_eff); /* dF/dd = 2 E* a */
  m.dt = 2.87 * pow(mass * mass / (e_star * e_star * r_eff * velocity), 0.2) / 20000;

  double v = velocity, most = 0, deepest = 0;
  unsigned beyond = 0;
  do {
    v -= 0.5 * m.dt * now.normal / mass;
    m.overlap += m.dt * v;
    m.approach = v;
    if (granulaw_advance(contact, 1, &m, history, &now, ledger, NULL)) return 1;
    beyond |= now.beyond;
    v -= 0.5 * m.dt * now.normal / mass;
    most = fmax(most, now.normal);
    deepest = fmax(deepest, m.overlap);
  } while (v > 0 || now.normal > 0);

  if (beyond)
    fprintf(stderr, "collide: beyond the law's %s\n",
            beyond & GRANULAW_BEYOND_OVERLAP ? "overlaps" : beyond & GRANULAW_BEYOND_SIZE ? "size" : "speeds");
  const double energy = 0.5 * mass * velocity * velocity;
  printf("e %.12g\nforce_max %.12g\ndelta_max %.12g\nplastic %.12g\nwaves %.12g\n", -v / velocity, most, deepest,
         ledger[GRANULAW_PLASTIC] / energy, ledger[GRANULAW_WAVES] / energy);
  granulaw_close_contact(contact);
  free(history);
  return 0;
}
