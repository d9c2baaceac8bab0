#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "common/control/feedforward.hpp"
#include "common/log/record.hpp"
#include "common/wire/codec.hpp"
#include "common/wire/codes.hpp"
#include "common/wire/model_registers.hpp"
#include "common/wire/register_map.hpp"

namespace cartwright::wire {
namespace {

TEST(Codec, MostSignificantRegisterFirst) {
  std::array<std::uint16_t, 4> words{};
  put_u32(words, 0x12345678);
  EXPECT_EQ(words[0], 0x1234);
  EXPECT_EQ(words[1], 0x5678);
  put_f32(words, 1.0F);  // IEEE 754: 0x3f800000
  EXPECT_EQ(words[0], 0x3f80);
  EXPECT_EQ(words[1], 0);
  put_f64(words, -2.0);  // IEEE 754: 0xc000000000000000
  EXPECT_EQ(words[0], 0xc000);
  EXPECT_EQ(words[3], 0);
}

TEST(Codec, EveryNumberComesBack) {
  std::mt19937_64 random(7);
  std::array<std::uint16_t, 4> words{};
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t bits = random();
    put_u64(words, bits);
    EXPECT_EQ(get_u64(words), bits);
    const double value = std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 100) - 120);
    put_f64(words, value);
    EXPECT_EQ(get_f64(words), value);
  }
  put_f64(words, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(std::isnan(get_f64(words)));
}

TEST(Codec, AFloatComesBackAsTheDecimalThatWasTyped) {
  const Register& amplitude = info(Id::step_amplitude_m);
  std::array<std::uint16_t, 2> words{};
  for (const double typed : {0.1, 0.16, 2.275e-5, 1.9, -0.3, 60.0}) {
    put(amplitude, words, typed);
    EXPECT_EQ(get(amplitude, words), typed);
  }
}

TEST(Codec, TextIsCutToFitAndPadded) {
  std::array<std::uint16_t, 3> words{};
  put_text(words, "cart");
  EXPECT_EQ(get_text(words), "cart");
  EXPECT_EQ(words[2], 0);
  put_text(words, "too long to fit");
  EXPECT_EQ(get_text(words), "too lo");
}

TEST(Codec, CrcMatchesItsPublishedCheckValue) {
  const std::string_view check = "123456789";
  const std::vector<std::uint8_t> bytes(check.begin(), check.end());
  EXPECT_EQ(crc32(std::span<const std::uint8_t>(bytes)), 0xcbf43926U);
  const auto first = crc32(std::span<const std::uint8_t>(bytes).first(4));
  EXPECT_EQ(crc32(std::span<const std::uint8_t>(bytes).subspan(4), first), 0xcbf43926U);
  const std::array<std::uint16_t, 2> words{0x3132, 0x3334};
  EXPECT_EQ(crc32(std::span<const std::uint16_t>(words)), first);
}

TEST(RegisterMap, FindsWhatCoversAnAddressAndNothingInTheGaps) {
  for (const Register& r : registers()) {
    for (std::uint16_t address = r.address; address < r.end(); ++address)
      EXPECT_EQ(at(address), &r) << r.name;
    EXPECT_EQ(find_register(r.name), r.id);
  }
  EXPECT_EQ(at(39), nullptr);
  EXPECT_EQ(at(map_end()), nullptr);
}

TEST(RegisterMap, NamesAreUniqueAndMeaningsAreThere) {
  std::set<std::string_view> seen;
  for (const Register& r : registers()) {
    EXPECT_TRUE(seen.insert(r.name).second) << r.name;
    EXPECT_FALSE(r.meaning.empty()) << r.name;
  }
}

TEST(RegisterMap, TheLogSchemaAndManyRowsFitTheirRegisters) {
  EXPECT_LE(log_schema().size(), 2U * info(Id::log_schema).count);
  EXPECT_GE(info(Id::log_window).count / kLogColumns, 30U);
}

TEST(RegisterMap, TheMarkdownHasALineForEveryRegisterAndCode) {
  const std::string text = register_map_markdown();
  for (const Register& r : registers()) EXPECT_NE(text.find(fmt::format("`{}`", r.name)), std::string::npos);
  for (std::uint16_t i = 0; i < kFaultCount; ++i) {
    EXPECT_NE(text.find(words(static_cast<Fault>(i))), std::string::npos);
  }
}

TEST(RegisterMap, HasARegisterForEveryNumberOfAModelThatTheFeedForwardKnows) {
  std::set<Parameter> held;
  for (const auto& [parameter, id] : kModelRegisters) {
    held.insert(parameter);
    std::string name = "model_" + dotted_name(parameter);
    std::replace(name.begin(), name.end(), '.', '_');
    EXPECT_EQ(info(id).name, name);
    EXPECT_GE(info(id).least, cartwright::info(parameter).lower) << name;
    EXPECT_LE(info(id).most, cartwright::info(parameter).upper) << name;
  }
  for (const ParameterInfo& parameter : parameters()) {
    EXPECT_EQ(held.contains(parameter.id), !parameter.term || has_inverse(*parameter.term))
        << dotted_name(parameter.id);
  }
}

TEST(Codes, AnUnknownCodeHasWordsToo) {
  EXPECT_EQ(name(static_cast<Fault>(999)), "unknown");
  EXPECT_EQ(find_experiment("relay"), ExperimentKind::relay);
  EXPECT_EQ(find_experiment("none"), std::nullopt);
}

TEST(Log, TimeSinceTheStartPrintsShort) {
  EXPECT_EQ(since_s(12345.680, 12344.446), 1.234);
}

}  // namespace
}  // namespace cartwright::wire
