#include "bench/lab/pose_graph.hpp"

#include <random>
#include <string>

#include <gmock/gmock.h>

namespace cairn::lab {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kSure[] = " 4 0 0 4 0 9";  // The information of an edge, g2o.

std::string refusal_of(const std::string& text) {
  const Result<PoseGraph> graph = parse_pose_graph(text);
  return graph ? "none" : graph.error().message;
}

std::string edge(int from, int to) {
  return "EDGE_SE2 " + std::to_string(from) + ' ' + std::to_string(to) + " 1 0 0" + kSure + '\n';
}

TEST(PoseGraph, ReadsVerticesAndEdgesOfG2o) {
  const Result<PoseGraph> graph = parse_pose_graph(
      "# a remark\n"
      "VERTEX_SE2 7 1.5 -2 0.25\r\n"
      "\n"
      "EDGE_SE2 7 3 +1e-1 0.2 0.3 11 12 13 22 23 33 \n"
      "VERTEX_SE2 3 0 0 0\n"
      "FIX 3");
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_THAT(graph->ids, ElementsAre(7, 3));
  EXPECT_EQ(graph->T_frame_vertex.front(), Pose2(1.5, -2.0, 0.25));
  ASSERT_EQ(graph->edges.size(), 1U);
  const PoseGraphEdge& only = graph->edges.front();
  EXPECT_EQ(only.from, 0);
  EXPECT_EQ(only.to, 1);
  EXPECT_EQ(only.T_from_to, Pose2(0.1, 0.2, 0.3));
  Matrix3d information;
  information << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  EXPECT_EQ(only.information, information);
  EXPECT_TRUE(graph->has_fixed_vertex);
  EXPECT_EQ(graph->anchor, 1);
}

TEST(PoseGraph, ReadsTheInformationOfToroInItsOwnOrder) {
  const Result<PoseGraph> graph =
      parse_pose_graph("VERTEX2 0 0 0 0\nVERTEX2 1 1 0 0\nEDGE2 0 1 1 0 0 11 12 22 33 13 23\n");
  ASSERT_TRUE(graph) << graph.error().message;
  Matrix3d information;
  information << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  EXPECT_EQ(graph->edges.front().information, information);
}

TEST(PoseGraph, WithoutVerticesThoseOfTheEdgesAreNumberedById) {
  const Result<PoseGraph> graph = parse_pose_graph(edge(9, 4) + edge(4, 12));
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_THAT(graph->ids, ElementsAre(4, 9, 12));
  EXPECT_TRUE(graph->T_frame_vertex.empty());
  EXPECT_EQ(graph->edges.front().from, 1);
}

TEST(PoseGraph, EdgesBetweenTheSameVerticesAllCount) {
  const Result<PoseGraph> graph =
      parse_pose_graph(edge(0, 1) + "EDGE_SE2 0 1 1.5 0 0 1 0 0 1 0 1\n" + edge(1, 0));
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_EQ(graph->edges.size(), 3U);
  EXPECT_EQ(graph->parallel_edges, 2);
}

TEST(PoseGraph, TheVerySameEdgeTwiceIsAnError) {
  const Result<PoseGraph> graph = parse_pose_graph(edge(0, 1) + edge(1, 2) + edge(0, 1));
  ASSERT_FALSE(graph);
  EXPECT_THAT(graph.error().message,
              HasSubstr("line 3: expected an edge of its own, got that of line 1 again"));
}

TEST(PoseGraph, OfOneVertexIsAGraph) {
  const Result<PoseGraph> graph = parse_pose_graph("VERTEX_SE2 0 1 2 3\n");
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_EQ(chi2_of(*graph, graph->T_frame_vertex), 0.0);
}

// The error is that of g2o: measured^-1 (from^-1 to), weighed in the frame of the measured pose.
TEST(PoseGraph, WeighsTheErrorInTheFrameOfTheMeasuredPose) {
  const Result<PoseGraph> graph =
      parse_pose_graph("EDGE_SE2 0 1 1 0 1.5707963267948966 100 0 0 1 0 1\n");
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_NEAR(chi2_of(*graph, {Pose2(), Pose2(1.0, 2.0, kPi / 2.0)}), 400.0, 1e-9);
  EXPECT_NEAR(chi2_of(*graph, {Pose2(), Pose2(3.0, 0.0, kPi / 2.0)}), 4.0, 1e-9);
}

TEST(PoseGraph, AsTravelsItHasTheSameChi2) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) {
    PoseGraph graph;
    graph.ids = {0, 1};
    Matrix3d root;
    for (double& entry : root.reshaped()) {
      entry = normal(random);
    }
    graph.edges.push_back({0, 1, Pose2(normal(random), normal(random), 3.0 * normal(random)),
                           root * root.transpose() + Matrix3d::Identity()});
    const TravelConstraint travel = travels_of(graph).front();
    const Pose2 T_from_to(normal(random), normal(random), 3.0 * normal(random));
    const double chi2 = chi2_of(graph, {Pose2(), T_from_to});
    EXPECT_NEAR(squared_mahalanobis(T_from_to, travel.T_from_to.mean, travel.T_from_to.covariance),
                chi2, 1e-9 * (1.0 + chi2));
  }
}

TEST(PoseGraph, IsReadAgainAsItWasWritten) {
  const Result<PoseGraph> graph = parse_pose_graph(
      "VERTEX2 5 0.1 0.2 0.3\nVERTEX2 2 1 0 0\nEDGE2 5 2 1 0 0.1 11 1 22 33 3 2\nFIX 2\n");
  ASSERT_TRUE(graph) << graph.error().message;
  const Result<PoseGraph> again = parse_pose_graph(to_g2o(*graph, graph->T_frame_vertex));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->ids, graph->ids);
  EXPECT_EQ(again->T_frame_vertex, graph->T_frame_vertex);
  EXPECT_EQ(again->edges.front().T_from_to, graph->edges.front().T_from_to);
  EXPECT_EQ(again->edges.front().information, graph->edges.front().information);
  EXPECT_EQ(again->anchor, graph->anchor);
}

TEST(PoseGraph, NamesLineExpectationAndWhatCame) {
  EXPECT_EQ(refusal_of("VERTEX_SE2 0 0 0\n"),
            "line 1: expected 'VERTEX_SE2 id x y theta', 5 words, got 4");
  EXPECT_THAT(refusal_of(edge(0, 1) + "EDGE_SE2 1 2 1 0 0 4 0 0 4 0\n"),
              HasSubstr("line 2: expected 'EDGE_SE2 from to x y theta xx xy xt yy yt tt', 12 "
                        "words, got 11"));
  EXPECT_THAT(refusal_of("EDGE_SE2 0 1 1 0 0 4 0 0 4 0 9 9\n"), HasSubstr("12 words, got 13"));
  EXPECT_EQ(refusal_of("VERTEX_SE2 zero 0 0 0\n"),
            "line 1: expected an id from 0 to 2147483647, got zero");
  EXPECT_THAT(refusal_of("VERTEX_SE2 -1 0 0 0\n"), HasSubstr("got -1"));
  EXPECT_THAT(refusal_of("VERTEX_SE2 99999999999 0 0 0\n"), HasSubstr("got 99999999999"));
  EXPECT_EQ(refusal_of("\n\nVERTEX_SE2 0 0 nan 0\n"),
            "line 3: expected a finite number for y, got nan");
  EXPECT_THAT(refusal_of("VERTEX_SE2 0 inf 0 0\n"), HasSubstr("for x, got inf"));
  EXPECT_THAT(refusal_of("VERTEX_SE2 0 1e999 0 0\n"), HasSubstr("for x, got 1e999"));
  EXPECT_THAT(refusal_of("VERTEX_SE2 0 0 0 0.1x\n"), HasSubstr("for theta, got 0.1x"));
  EXPECT_THAT(refusal_of("EDGE_SE2 0 1 1 0 0 nan 0 0 4 0 9\n"),
              HasSubstr("line 1: expected a finite number for the information, got nan"));
}

TEST(PoseGraph, RefusesOtherElementsByName) {
  EXPECT_THAT(refusal_of("VERTEX_XY 3 0 0\n"),
              HasSubstr("line 1: expected VERTEX_SE2, EDGE_SE2, FIX (g2o), VERTEX2 or EDGE2 "
                        "(TORO), got VERTEX_XY"));
  EXPECT_THAT(refusal_of("VERTEX_SE3:QUAT 3 0 0 0 0 0 0 1\n"), HasSubstr("got VERTEX_SE3:QUAT"));
  EXPECT_THAT(refusal_of("\x01\xff junk\n"), HasSubstr("got ??"));
}

TEST(PoseGraph, RefusesInformationThatIsNotPositiveDefinite) {
  const std::string begin = "EDGE_SE2 0 1 1 0 0 ";
  for (const char* information : {"4 0 0 4 0 0", "4 4 0 4 0 9", "4 0 0 -4 0 9", "1 2 0 1 0 1",
                                  "0 0 0 0 0 0", "-1 0 0 -1 0 -1"}) {
    EXPECT_THAT(refusal_of(begin + information),
                HasSubstr("line 1: expected a positive definite information matrix, got"))
        << information;
  }
  EXPECT_THAT(refusal_of(begin + "1e300 0 0 1e300 0 1e300"),
              HasSubstr("line 1: the inverse of the information: displacement: "));
}

TEST(PoseGraph, RefusesEdgesThatJoinNoTwoVertices) {
  EXPECT_EQ(refusal_of(edge(0, 1) + edge(2, 2)),
            "line 2: expected an edge between two vertices, got one from 2 to itself");
  EXPECT_EQ(refusal_of("VERTEX_SE2 0 0 0 0\n" + edge(0, 1)),
            "line 2: expected the id of a vertex of the file, got 1");
  EXPECT_EQ(refusal_of(edge(0, 1) + "FIX 2"),
            "line 2: expected the id of a vertex of the file, got 2");
}

TEST(PoseGraph, RefusesIdsThatComeTwice) {
  EXPECT_EQ(refusal_of("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 0 1 0 0\n"),
            "line 2: expected a vertex of its own, got id 0 again (line 1)");
  EXPECT_EQ(refusal_of(edge(0, 1) + "FIX 0\nFIX 1\n"),
            "line 3: expected one fixed vertex (line 2), got a second one, 1");
}

TEST(PoseGraph, CountsThePiecesOfADisconnectedGraph) {
  EXPECT_EQ(refusal_of(edge(0, 1) + edge(5, 4) + edge(8, 9)),
            "expected a graph in one piece, got 3 pieces: no edges lead from vertex 0 to vertex 4");
  EXPECT_THAT(refusal_of("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 0 0 0\n"), HasSubstr("2 pieces"));
}

TEST(PoseGraph, RefusesAFileWithNothingInIt) {
  EXPECT_THAT(refusal_of(""), HasSubstr("got none"));
  EXPECT_THAT(refusal_of("# nothing\n\n"), HasSubstr("got none"));
}

}  // namespace
}  // namespace cairn::lab
