/* Forces of one contact by granulaw.h, a line for each line of motion on the standard input:
 *     contact_forces LAW A B FRICTION SHEAR_STIFFNESS SHEAR_DAMPING history|plastic
 *     R* m* overlap approach dt nx ny nz slide_x slide_y slide_z turn_x turn_y turn_z
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "granulaw.h"

int main(int argc, char **argv)
{
  granulaw_law *law;
  granulaw_contact_law *contact;
  granulaw_why why;
  granulaw_pair pair = {0};
  if (argc != 8) return 2;
  pair.a = argv[2], pair.b = argv[3];
  pair.friction = atof(argv[4]), pair.shear_stiffness = atof(argv[5]), pair.shear_damping = atof(argv[6]);
  pair.yields_in_shear = strcmp(argv[7], "plastic") == 0;
  if (granulaw_open(argv[1], &law, &why) || granulaw_contact(law, &pair, &contact, &why)) {
    fprintf(stderr, "%s\n", why.text);
    return 1;
  }
  double *kept = calloc(granulaw_kept(contact), sizeof *kept);
  granulaw_motion m = {0};
  granulaw_answer now;
  while (scanf("%lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", &m.r_eff, &m.m_eff, &m.overlap, &m.approach,
               &m.dt, &m.normal[0], &m.normal[1], &m.normal[2], &m.slide[0], &m.slide[1], &m.slide[2], &m.turn[0],
               &m.turn[1], &m.turn[2]) == 14) {
    if (granulaw_advance(contact, 1, &m, kept, &now, NULL)) return 1;
    printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", now.normal, now.shear[0], now.shear[1], now.shear[2],
           now.couple[0], now.couple[1], now.couple[2]);
  }
  granulaw_close_contact(contact);
  granulaw_close(law);
  free(kept);
  return 0;
}
