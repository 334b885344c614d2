// Jets of CGAL: at each vertex the Monge form fitted to a set of points.

#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

using Kernel = CGAL::Simple_cartesian<double>;

// points (V, 3); vertex v is fitted to points[sets[k]], start[v] <= k < start[v + 1], its own among
// them; normals (V, 3), nonzero, turn the form. out (V, 8): larger and smaller principal curvature
// and their directions; NaN where the points do not determine a polynomial of the degree.
extern "C" void jets(const double *points, const int64_t *start, const int64_t *sets,
                     const double *normals, int64_t count, int degree, double *out) {
  const int64_t unknowns = (degree + 1) * (degree + 2) / 2;
  std::vector<Kernel::Point_3> near;
  for (int64_t v = 0; v < count; ++v) {
    double *found = out + 8 * v;
    std::fill(found, found + 8, std::nan(""));
    if (start[v + 1] - start[v] < unknowns) continue;
    near.clear();
    for (int64_t k = start[v]; k < start[v + 1]; ++k) {
      const double *p = points + 3 * sets[k];
      near.emplace_back(p[0], p[1], p[2]);
      // The form is that at the first point.
      if (sets[k] == v) std::swap(near.front(), near.back());
    }
    CGAL::Monge_via_jet_fitting<Kernel> fitting;
    auto form = fitting(near.begin(), near.end(), degree, 2);
    const double *n = normals + 3 * v;
    form.comply_wrt_given_normal(Kernel::Vector_3(n[0], n[1], n[2]));
    const auto first = form.maximal_principal_direction();
    const auto second = form.minimal_principal_direction();
    for (int i = 0; i < 2; ++i) found[i] = form.principal_curvatures(i);
    for (int i = 0; i < 3; ++i) found[2 + i] = first[i], found[5 + i] = second[i];
  }
}
