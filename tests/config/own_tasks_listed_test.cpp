// Tasks that a user's program registers are in lists and schemas, as the library's are.
#include "surefoot/config/json_schema.hpp"
#include "surefoot/config/option_list.hpp"
#include "tests/control/own_task.hpp"
#include "tests/support/anymal_b.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace surefoot::config {
namespace {

TEST(OwnTasks, AreAmongTheOptions) {
  const auto rows = list_options("tasks.own.", test::anymal_b(), test::own_tasks());
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].key, "tasks.own.acceleration");
  EXPECT_EQ(rows[0].unit, "m/s²");
  EXPECT_TRUE(list_options("tasks.own.", test::anymal_b()).empty());
}

TEST(OwnTasks, AreInTheSchemasOfStacksAndScenarios) {
  const auto schema = [](const char* kind) {
    return nlohmann::json::parse(json_schema(kind, test::own_tasks())).dump();
  };
  EXPECT_NE(schema("stack").find(R"({"const":"own"})"), std::string::npos);
  EXPECT_NE(schema("scenario").find(R"("own":{"anyOf")"), std::string::npos);
  EXPECT_NE(schema("randomisation").find("tasks.own.acceleration"), std::string::npos);
  EXPECT_EQ(json_schema("stack").find(R"("own")"), std::string::npos);
}

}  // namespace
}  // namespace surefoot::config
