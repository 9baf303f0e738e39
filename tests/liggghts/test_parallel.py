"""Two MPI ranks: a clean stop when something is wrong (the same physics: test_history.py)."""
from programs import LAUNCHER, run
import gas
from harness import POWDER, Deck, head, properties


# Stands before LIGGGHTS's function on one rank: memory ends there, where a run begins.
LONE_FAULT = r"""
#include <dlfcn.h>
#include <cstring>
#include <new>
#define FIND _ZN9LAMMPS_NS6Modify17find_fix_propertyEPKcS2_S2_iiS2_b
#define TEXT_OF(name) #name
#define TEXT(name) TEXT_OF(name)
extern "C" void* FIND(void* self, const char* name, const char* style, const char* kind, int a, int b, const char* caller, bool required)
{
  if (std::strcmp(name, "youngsModulus") == 0) throw std::bad_alloc();
  return reinterpret_cast<decltype(&FIND)>(dlsym(RTLD_NEXT, TEXT(FIND)))(self, name, style, kind, a, b, caller, required);
}
"""


class TestParallel(Deck):
    def prepare(self):
        gas.data_file(self.folder / "gas.data")

    def test_a_contact_whose_type_loses_its_law_on_one_rank(self):
        """The sums over pairs of types, two to a rank, have the same terms on both: the statistics are answered."""
        deck = head(types=2, half=0.02, extra="", skin=1e-3) + properties([POWDER, POWDER], 0.3)
        deck += f"pair_style gran model mpm tangential history law {self.law} materials powder none\npair_coeff * *\n"
        deck += "".join(f"create_atoms 1 single 0 0 {z} units box\n" for z in (-0.01, -0.00802, 0.01, 0.01198))
        text = self.run_deck(deck + "set group all diameter 0.002 density 1500\nfix i all nve/sphere\ntimestep 1e-8\nrun 5\n"
                             "group one id 1\nset group one type 2\nvariable c equal f_granulaw[1][1]\n" 'print "BEGUN ${c}"\n', ranks=2)
        assert self.result(text, "BEGUN") == [2.0]

    def test_error_stops_all_ranks(self):
        for words, sentence in ((f"law missing.h5 materials powder", "missing.h5"),
                                (f"law {self.law} materials chalk", "no material 'chalk'")):
            deck = gas.start() + gas.model(words) + gas.MOVE + "run 1\n"
            text = self.run_deck(deck, ranks=2, expect_failure=True)
            assert text.count("ERROR") == 1, text[-2000:]
            assert sentence in text


class TestAlone(Deck):
    def test_error_of_one_rank_alone_ends_the_run(self):
        """The others wait for it in a sum; without its message they would do so for ever. It comes after 20 s (run/stop.cpp)."""
        gas.data_file(self.folder / "gas.data")
        (self.folder / "fault.cpp").write_text(LONE_FAULT)
        run("c++", "-shared", "-fPIC", self.folder / "fault.cpp", "-o", self.folder / "fault.so")
        start = self.folder / "start"
        start.write_text(f'#!/bin/sh\n[ "$OMPI_COMM_WORLD_RANK" = 1 ] && export LD_PRELOAD={self.folder}/fault.so\nexec {LAUNCHER} "$@"\n')
        start.chmod(0o755)
        deck = gas.start() + gas.model(f"law {self.law} materials powder") + gas.MOVE + "run 1\n"
        assert "ERROR on proc 1: std::bad_alloc" in self.run_deck(deck, ranks=2, launcher=start, expect_failure=True)
