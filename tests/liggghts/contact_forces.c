/* Forces of one contact by granulaw.h, a line for each line of motion on the standard input:
 *     contact_forces LAW A B FRICTION SHEAR_STIFFNESS SHEAR_DAMPING history|plastic
 *     R_a R_b m* overlap approach dt nx ny nz slide_x slide_y slide_z rolling_x rolling_y rolling_z
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
  granulaw_pair pair;
  if (argc != 8) return 2;
  granulaw_usual_pair(&pair, sizeof pair);
  pair.elastic_damping = 0;
  pair.a = argv[2], pair.b = argv[3];
  pair.friction = atof(argv[4]), pair.shear_stiffness = atof(argv[5]), pair.shear_damping = atof(argv[6]);
  pair.yields_in_shear = strcmp(argv[7], "plastic") == 0;
  if (granulaw_open(argv[1], &law, &why) || granulaw_contact(law, &pair, &contact, &why)) {
    fprintf(stderr, "%s\n", why.text);
    return 1;
  }
  double *history = calloc(granulaw_history(contact), sizeof *history);
  granulaw_motion m = {0};
  granulaw_answer now = {0};
  m.size = sizeof m, now.size = sizeof now;
  while (scanf("%lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf %lf", &m.radius_a, &m.radius_b, &m.m_eff, &m.overlap, &m.approach,
               &m.dt, &m.normal[0], &m.normal[1], &m.normal[2], &m.slide[0], &m.slide[1], &m.slide[2], &m.rolling[0],
               &m.rolling[1], &m.rolling[2]) == 15) {
    if (granulaw_advance(contact, 1, &m, history, &now, NULL, NULL)) return 1;
    printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", now.normal, now.shear[0], now.shear[1], now.shear[2],
           now.couple[0], now.couple[1], now.couple[2]);
  }
  granulaw_close_contact(contact);
  granulaw_close(law);
  free(history);
  return 0;
}
