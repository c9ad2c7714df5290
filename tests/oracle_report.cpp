#include "tests/oracle_report.h"

#include <cmath>
#include <random>
#include <sstream>
#include <stdexcept>

#include "harness/base/conversions.h"
#include "harness/oracle/forced_zones.h"
#include "harness/oracle/numbers.h"
#include "harness/oracle/oracle.h"

namespace cutbench::oracle {
namespace {

Request request_of(const oracle_report::Cut& cut) {
  Request request;
  request.before = {cut.before.rest, cut.before.triangles};
  for (const auto& [bezier, closed, points] : cut.curves) request.cuts.push_back({bezier, closed, points});
  request.tolerance = cut.tolerance;
  request.snap = cut.snap;
  request.thin = cut.thin;
  request.vertex_tolerance = cut.vertex_tolerance;
  request.keeps_vertices = cut.keeps_vertices;
  request.exact_incision = cut.exact_incision;
  request.keeps_area = cut.keeps_area;
  return request;
}

void write(std::ostream& out, const Judgement& judgement) {
  out << judgement.verdict << ' ' << judgement.ok << ' ' << judgement.pieces << ' ' << judgement.expected_pieces << ' '
      << judgement.least_pieces << ' ' << judgement.most_pieces << ' ' << judgement.incision_error << ' '
      << judgement.area_change << '\n';
  for (const std::string& problem : judgement.problems) out << problem << '\n';
}

void write(std::ostream& out, const Point& p) { out << p[0] << ' ' << p[1] << ' '; }

void write(std::ostream& out, const ForcedCorner& corner) {
  write(out, corner.apex);
  write(out, corner.leg1);
  write(out, corner.leg2);
  out << corner.angle << ' ' << corner.apex_tolerance << ' ';
  for (const Point& p : corner.wedge) write(out, p);
  out << '\n';
}

void write(std::ostream& out, const ForcedZones& zones) {
  for (const auto* flags : {&zones.in_corner, &zones.in_zone, &zones.near_zone})
    for (const char flag : *flags) out << (flag ? '1' : '0');
  out << ' ' << zones.corner_triangles << ' ' << zones.zone_triangles << ' ' << zones.corner_area << ' '
      << zones.zone_area << '\n';
}

}  // namespace

std::string report(const oracle_report::Cut& cut) {
  std::ostringstream out;
  out << std::hexfloat;
  try {
    const Request request = request_of(cut);
    const Mesh after{cut.after.rest, cut.after.triangles};
    write(out, judge(request, after));
    const std::vector<ForcedCorner> corners = forced_corners(request.before, request.cuts, cut.mean_edge);
    for (const ForcedCorner& corner : corners) write(out, corner);
    write(out, forced_zones(corners, after, cut.mean_edge));
  } catch (const std::invalid_argument& error) {
    out << error.what() << '\n';
  }
  return out.str();
}

std::string report_of_fractions(std::size_t count) {
  std::mt19937_64 random(7);
  std::ostringstream out;
  out << std::hexfloat;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = [&] { return std::ldexp(to_double(to_int64(random())), -20); };
    const double a = number(), b = number();
    const int exponent = to_int(random() % 1900) - 1150;
    const Rational quotient = fraction(as_integer(a, -1100), as_integer(b, -1100), exponent);
    const Rational sum = quotient + as_rational(std::ldexp(a, exponent % 500));
    out << toward_zero(quotient) << ' ' << toward_zero(sum) << ' ' << order(quotient, sum) << '\n';
  }
  return out.str();
}

}  // namespace cutbench::oracle
