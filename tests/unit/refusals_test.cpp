// Materials that mpm refuses: file, line, key, what was found, what is allowed (particles: materials_file_test.cpp; one of each kind by process: tests/cli).
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "material_file/materials_file.hpp"
#include "scratch_folder.hpp"

namespace granulaw::refusals_test {

using RefusalsTest = ScratchFolder;

constexpr const char* good =
    "[material.powder]\ndensity = 1500\nyoungs_modulus = 9.1e9\npoisson_ratio = 0.3\nyield_stress = 100e6\n"  // lines 1 to 5
    "[particle.grain]\nradius = 2e-3\nmaterial = \"powder\"\n";                                               // lines 6 to 8

TEST_F(RefusalsTest, MaterialsThatCannotBeUsed)
{
  const std::string plastic = "yield_stress = 100e6", hardening = "yield_stress = 1e8\nhardening = ";
  const struct
  {
    std::string old, change;
    std::vector<std::string> said;
  } cases[] = {
      {"1500", "-1", {":2:", "density"}},
      {"9.1e9", "-9.1e9", {":3:", "youngs_modulus", "-9.1e+09", "over 0"}},
      {"poisson_ratio = 0.3", "poisson_ratio = 0.5", {":4:", "poisson_ratio", "0.5"}},
      {plastic, "yield_stress = 2e9", {":5:", "yield_stress", "2e+09 Pa", "a tenth of E*", "1e+09 Pa"}},
      {plastic, hardening + "{law = \"linear\", modulus = 1e11}", {":6:", "modulus", "youngs_modulus"}},
      {"density = 1500", "density = 1500\n" + std::string(400, 'k') + " = 1", {":3:", "unknown key", "kkk...'"}},
      {"density = 1500", "densty = 1500", {":2:", "densty", "did you mean 'density'"}},
      {"density = 1500\n", "", {"density", "missing"}},
      {"density = 1500", "density = \"heavy\"", {"density", "number", "kg/m^3"}},
      {"density = 1500", "density = nan", {"density"}},
      {"density = 1500", "density = ", {":2:"}},
      {"\"powder\"", "\"powdr\"", {"powdr", "did you mean 'powder'"}},
      {"2e-3", "0", {"radius", "over 0"}},
      {plastic, hardening + "{law = \"vose\", modulus = 1}", {"vose", "did you mean 'voce'"}},
      {plastic, hardening + "{law = \"voce\", modulus = 1}", {":6:", "modulus", "saturation_stress"}},
      {plastic, hardening + "{law = \"swift\", strength = 1e8, exponent = 0.2, ofset = 0.01}", {"ofset", "did you mean 'offset'"}},
      {plastic, hardening + "{law = \"swift\", strength = 1e8, exponent = 0.2, offset = 0.01}", {"starts at 3.98107e+07 Pa", "yield_stress"}},
      {plastic, hardening + "{law = \"tabulated\", strain = [0, 0.1], stress = 3}", {"stress", "list", "Pa"}},
      {plastic, "yield_stress = 1e8\nrate = {a = 1}", {"rate", "law"}},
      {plastic, "rate = {law = \"cowper-symonds\", reference_rate = 40, exponent = 5}", {"rate", "yield_stress"}},
      {"[particle.grain]", "[particel.grain]", {"particel", "did you mean 'particle'"}},
  };
  EXPECT_EQ(sentence_of([&] { read_materials(write("m.toml", good)).particle("grain"); }), "");
  for (const auto& [old, change, said] : cases) {
    std::string text = good;
    text.replace(text.find(old), old.size(), change);
    const std::string found = sentence_of([&] { read_materials(write("m.toml", text)).particle("grain"); });
    EXPECT_TRUE(found.starts_with(path("m.toml"))) << change << "\nfound: " << found;
    for (const std::string& part : said)
      EXPECT_NE(found.find(part), std::string::npos) << "wanted: " << part << "\nfound:  " << found;
  }
}

}  // namespace granulaw::refusals_test
