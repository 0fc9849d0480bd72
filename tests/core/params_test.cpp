// Parameters and registry: defaults, types, bounds, names and errors from one list.
#include "core/params.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/number_text.hpp"
#include "core/registry.hpp"
#include "core/special_values.hpp"

namespace scanbench {
namespace {

using ::testing::HasSubstr;

enum class Fit { end_points, tls };

struct Complete {
  double threshold_m = 0.1;
  int count = 3;
  bool on = false;
  Fit fit = Fit::tls;
  std::vector<double> angles = {1.0, 2.0};
  NamedPoints points;
  static auto fields() {
    return std::tuple{field("threshold_m", &Complete::threshold_m, above(0), "m", "a length"),
                      field("count", &Complete::count, between(1, 9), "", "a count"),
                      field("on", &Complete::on, "a switch"),
                      choice("fit", &Complete::fit, {{Fit::end_points, "end_points"}, {Fit::tls, "tls"}}, "a choice"),
                      field("angles", &Complete::angles, between(-180, 180), "deg", "angles"),
                      field("points", &Complete::points, any_number(), "m", "points")};
  }
};

struct Forgetful {
  double a = 0.0;
  double b = 0.0;
  static auto fields() { return std::tuple{field("a", &Forgetful::a, any_number(), "", "a")}; }
};

static_assert(params_complete<Complete>());
static_assert(!params_complete<Forgetful>(), "a member that fields() does not name must be noticed");
static_assert(params_complete<NoParams>());

std::string message(const ParamSet& set) {
  try {
    make_params<Complete>(set);
  } catch (const ParamError& error) {
    return error.what();
  }
  return "";
}

TEST(Params, KeepTheirDefaultsAndTakeGivenValues) {
  const auto params = make_params<Complete>({{"threshold_m", 0.5}, {"fit", std::string("end_points")}});
  EXPECT_EQ(params.threshold_m, 0.5);
  EXPECT_EQ(params.fit, Fit::end_points);
  EXPECT_EQ(params.count, 3);
  EXPECT_EQ(params.angles.size(), 2u);
}

TEST(Params, AreTheSameAfterConversionToASetAndBack) {
  Complete params;
  params.threshold_m = 0.1 + 0.2;
  params.points = {{"B", {1, 2}}, {"A", {3, 4}}};
  const auto again = make_params<Complete>(to_param_set(params));
  EXPECT_EQ(again.threshold_m, params.threshold_m);
  EXPECT_EQ(again.points, params.points);
}

TEST(Params, AcceptAWholeNumberForANumber) {
  EXPECT_EQ(make_params<Complete>({{"threshold_m", std::int64_t{2}}}).threshold_m, 2.0);
}

TEST(Params, RefuseWithTheValueFoundAndTheValuesAllowed) {
  EXPECT_EQ(message({{"threshold_m", -1.0}}), "threshold_m is -1; allowed: a number > 0 m");
  EXPECT_EQ(message({{"threshold_m", kNaN}}), "threshold_m is nan; allowed: a number > 0 m");
  EXPECT_EQ(message({{"count", std::int64_t{10}}}), "count is 10; allowed: a whole number 1 .. 9");
  EXPECT_THAT(message({{"count", 2.5}}), HasSubstr("allowed: a whole number"));
  EXPECT_EQ(message({{"fit", std::string("lsq")}}), "fit is 'lsq'; allowed: end_points, tls");
  EXPECT_THAT(message({{"on", std::int64_t{1}}}), HasSubstr("true, false"));
  EXPECT_THAT(message({{"angles", std::vector<double>{0, 181}}}), HasSubstr("angles is 181"));
}

TEST(Params, NameTheNearestKnownNameForAMisspeltOne) {
  EXPECT_THAT(message({{"treshold_m", 0.1}}), HasSubstr("did you mean 'threshold_m'"));
  EXPECT_THAT(message({{"zzzzzzzz", 0.1}}), HasSubstr("known: threshold_m, count"));
}

struct Turn {
  double angle_rad = radians(10.0);
  static auto fields() { return std::tuple{degrees_field("angle_deg", &Turn::angle_rad, between(0, 30), "an angle")}; }
};

TEST(Params, InDegreesAreInRadiansInside) {
  const std::vector<ParamSpec> specs = param_specs<Turn>();
  EXPECT_EQ(specs[0].unit, "deg");
  EXPECT_NEAR(std::get<double>(specs[0].default_value), 10.0, 1e-14);
  EXPECT_NEAR(make_params<Turn>({{"angle_deg", 30.0}}).angle_rad, kPi / 6, 1e-16);
  EXPECT_THROW(make_params<Turn>({{"angle_deg", 31.0}}), ParamError);
  EXPECT_EQ(resolve(specs, {{"angle_deg", 0.2}}), (ParamSet{{"angle_deg", 0.2}}));  // as written
}

TEST(NumberText, ReadsBackToTheSameNumber) {
  for (const double v : {0.1, 1.0 / 3, 1e-300, 123456789.123, -0.0}) EXPECT_EQ(*parse_number(number_text(v)), v);
}

TEST(NumberText, RefusesEverythingButPlainDecimalNumbers) {
  for (const char* text : {"", "nan", "inf", "-inf", "0x10", "1,5", "1.5 ", " 1", "++1", "1e999", "one"})
    EXPECT_FALSE(parse_number(text)) << text;
  EXPECT_EQ(parse_number("+1.5e2"), 150.0);
  EXPECT_FALSE(parse_integer("1.0"));
  EXPECT_EQ(parse_integer("-12"), -12);
}

struct Animal {
  static constexpr std::string_view kKind = "animal";
  virtual ~Animal() = default;
  virtual double legs() const = 0;
};

class Dog final : public Animal {
 public:
  using Params = Complete;
  explicit Dog(Params params) : params_(std::move(params)) {}
  double legs() const override { return params_.threshold_m; }

 private:
  Params params_;
};

SCANBENCH_REGISTER(Animal, Dog, {.name = "dog", .summary = "barks", .reference = ""});

TEST(Registry, MakesAModuleFromItsParameters) {
  ASSERT_NE(Registry<Animal>::find("dog"), nullptr);
  EXPECT_EQ(Registry<Animal>::make("dog", {{"threshold_m", 4.0}})->legs(), 4.0);
  EXPECT_THROW(Registry<Animal>::make("dog", {{"legs", 4.0}}), ParamError);
}

TEST(Registry, NamesTheKnownModulesForAnUnknownOne) {
  try {
    Registry<Animal>::make("cat");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "unknown animal 'cat'; known: dog");
  }
}

TEST(Registry, RefusesANameThatIsTaken) {
  EXPECT_THROW(Registry<Animal>::add<Dog>({.name = "dog", .summary = "", .reference = ""}), InternalError);
}

TEST(Params, MessagesWriteBoundsAndValuesWithoutExponents) {
  EXPECT_EQ(between(1, 1e6).describe(), "1 .. 1000000");
  EXPECT_EQ(above(1e-4).describe(), "> 0.0001");
  EXPECT_EQ(at_least(1e-9).describe(), ">= 1e-09");
  const ParamSpec spec{"beams", ParamType::integer, std::int64_t{1}, between(1, 1e5), "", "", {}};
  EXPECT_THAT([&] { checked(spec, std::int64_t{1000000}); },
              ::testing::ThrowsMessage<ParamError>("beams is 1000000; allowed: a whole number 1 .. 100000"));
}

}  // namespace
}  // namespace scanbench
