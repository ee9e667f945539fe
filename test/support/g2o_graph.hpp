#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "layout/place_layout.hpp"

namespace cairn::test {

/// A pose graph as travels between places, numbered in the order of the file's ids.
struct G2oGraph {
  int place_count = 0;
  std::vector<TravelConstraint> travels;
};

/// The EDGE_SE2 lines of a g2o file. g2o weighs the difference of poses in the frame of the
/// measured pose; it is turned to the frame of departure, which leaves every chi2 as it is.
inline G2oGraph read_g2o(const std::filesystem::path& path) {
  G2oGraph graph;
  std::map<int, int> place_of_id;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string tag;
    TravelConstraint travel;
    double x = 0.0;
    double y = 0.0;
    double theta = 0.0;
    Matrix3d information;
    if (!(words >> tag >> travel.from >> travel.to >> x >> y >> theta) || tag != "EDGE_SE2") {
      continue;
    }
    for (int row = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column) {
        words >> information(row, column);
        information(column, row) = information(row, column);
      }
    }
    Matrix3d rotation = Matrix3d::Identity();
    rotation.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(theta).toRotationMatrix();
    travel.T_from_to.mean = Pose2(x, y, theta);
    const Matrix3d covariance = rotation * information.inverse() * rotation.transpose();
    travel.T_from_to.covariance = 0.5 * (covariance + covariance.transpose());
    place_of_id[travel.from] = place_of_id[travel.to] = 0;
    graph.travels.push_back(travel);
  }
  for (auto& [id, place] : place_of_id) {
    place = graph.place_count++;
  }
  for (TravelConstraint& travel : graph.travels) {
    travel.from = place_of_id.at(travel.from);
    travel.to = place_of_id.at(travel.to);
  }
  return graph;
}

}  // namespace cairn::test
