#include "codec/option_object.hpp"

#include <gmock/gmock.h>

namespace cairn {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Lamp {
  double brightness = 0.5;
  int bulbs = 3;
  bool is_on = true;
  std::string name = "desk";
  int colour = 0;
  std::vector<std::string> rooms = {"study"};
};

struct House {
  std::vector<Lamp> lamps = std::vector<Lamp>(1);
  double size_m = 10.0;
};

OptionObject describe(Lamp* lamp) {
  OptionObject object("lamp", "A lamp.");
  object.number("brightness", &lamp->brightness, {0, 1}, "How bright.")
      .integer("bulbs", &lamp->bulbs, {1, 10}, "How many.")
      .flag("is_on", &lamp->is_on, "Whether.")
      .text("name", &lamp->name, "Which.")
      .choice(
          "colour", [lamp] { return lamp->colour; }, [lamp](int c) { lamp->colour = c; },
          {"white", "red"}, "Of its light.")
      .texts("rooms", &lamp->rooms, "Where.");
  return object;
}

OptionObject describe(House* house) {
  OptionObject object("house", "A house.");
  object.number("size_m", &house->size_m, {1, 100}, "Along its side.")
      .list(
          "lamps", [house] { return house->lamps.size(); },
          [house](std::size_t size) { house->lamps.resize(size); },
          [house](std::size_t i) { return describe(&house->lamps[i]); }, "All of them.");
  return object;
}

TEST(OptionObject, WritesWhatItReads) {
  House house;
  const std::string text =
      R"({"size_m":12.5,"lamps":[{"brightness":0.25,"bulbs":7,"is_on":false,"name":"hall",)"
      R"("colour":"red","rooms":["a","b"]}]})";
  ASSERT_TRUE(describe(&house).read(*parse_json(text)).ok());
  EXPECT_EQ(describe(&house).write().dump(), text);
}

TEST(OptionObject, KeepsTheDefaultOfWhatIsNotSaid) {
  House house;
  ASSERT_TRUE(describe(&house).read(*parse_json(R"({"lamps":[{"bulbs":5}, {}]})")).ok());
  ASSERT_EQ(house.lamps.size(), 2U);
  EXPECT_EQ(house.lamps[0].bulbs, 5);
  EXPECT_EQ(house.lamps[0].name, "desk");
  EXPECT_EQ(house.size_m, 10.0);
}

TEST(OptionObject, TellsPathRuleAndValueOfEveryViolation) {
  House house;
  const Status status = describe(&house).read(*parse_json(
      R"({"size_m":"big","lamps":[{"bulbs":2.5,"colour":"green","rooms":[1]}],"garage":{}})"));
  ASSERT_FALSE(status.ok());
  const std::string& message = status.error().message;
  EXPECT_THAT(message, HasSubstr("size_m must be in [1, 100], is \"big\""));
  EXPECT_THAT(message, HasSubstr("lamps[0].bulbs must be a whole number in [1, 10], is 2.5"));
  EXPECT_THAT(message, HasSubstr("lamps[0].colour must be one of white, red, is \"green\""));
  EXPECT_THAT(message, HasSubstr("lamps[0].rooms must be a list of strings, is [1]"));
  EXPECT_THAT(message, HasSubstr("garage is not an option"));
}

TEST(OptionObject, RefusesAListBeyondItsBound) {
  House house;
  Json json;
  json["lamps"] = Json(std::vector<Json>(65, Json::object()));
  EXPECT_FALSE(describe(&house).read(json).ok());
}

TEST(OptionObject, GivesASchemaWithRangesAndNoOtherKeys) {
  House house;
  const Json schema = describe(&house).schema();
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["properties"]["size_m"]["maximum"], 100);
  EXPECT_EQ(schema["properties"]["lamps"]["items"]["properties"]["colour"]["enum"][1], "red");
}

TEST(OptionObject, TabulatesEveryLeaf) {
  House house;
  EXPECT_THAT(describe(&house).table(),
              HasSubstr("| `lamps[].bulbs` | `3` | [1, 10] | How many. |"));
}

TEST(ParseJson, TellsWhereTextIsNoJson) {
  const Result<Json> json = parse_json("{\n\n \"a\": nope }");
  ASSERT_FALSE(json.ok());
  EXPECT_THAT(json.error().message, HasSubstr("line 3"));
  EXPECT_THAT(json.error().message, StartsWith("expected JSON: parse error at line 3"));
  EXPECT_EQ(parse_json(" \n").error().message, "expected a JSON object, is empty");
}

}  // namespace
}  // namespace cairn
