// SPDX-License-Identifier: GPL-3.0-or-later
// Layout in pixels: title and note above, key (what each colour is) below them, then the plot.
#include "core/study/chart_svg.hpp"

#include "core/study/chart_labels.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace plyform {

namespace {

constexpr double width = 800, height = 520, label_size = 12;
constexpr PixelBox plot{72, 112, 780, 462};

/// Okabe and Ito's colours, which the colour-blind tell apart; every dial has a marker of its own
/// too.
constexpr const char* colours[] = {"#0072b2", "#d55e00", "#009e73",
                                   "#cc79a7", "#e69f00", "#56b4e9"};
/// The same for small letters, darker where the line's colour is too light to be read.
constexpr const char* letters[] = {"#0072b2", "#b84f00", "#007d5b",
                                   "#a8437c", "#8f6200", "#1b6fa3"};
constexpr std::size_t colour_count = std::size(colours);
constexpr const char* ink = "#222222";
constexpr const char* grey = "#8a8a8a";

/// Text that XML may hold: markup escaped, control characters as spaces.
std::string xml(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

/// A logarithmic axis: decades between two numbers onto pixels.
struct Axis {
  double low = 0, high = 1; ///< log10
  double from = 0, to = 1;  ///< pixels
  double operator()(double value) const {
    const double u = std::clamp(std::log10(value), low, high);
    return from + (to - from) * (u - low) / (high - low);
  }
};

/// All values with room around them; at least a third of a decade.
Axis axis_of(const std::vector<double>& values, double from, double to, double room_above) {
  double low = 1e300, high = -1e300;
  for (const double value : values) {
    if (!(value > 0.0) || !std::isfinite(value)) continue;
    low = std::min(low, std::log10(value));
    high = std::max(high, std::log10(value));
  }
  if (low > high) low = high = 0.0;
  const double lack = std::max(0.0, 0.35 - (high - low)), span = std::max(high - low, 0.35);
  return {low - 0.5 * lack - 0.09 * span, high + 0.5 * lack + room_above * span, from, to};
}

/// Round numbers within the axis: the decades alone on a long one, more on a short one.
std::vector<double> ticks(const Axis& axis) {
  const double decades = axis.high - axis.low;
  std::vector<double> steps{1.0};
  if (decades < 3.0) steps = {1.0, 2.0, 5.0};
  if (decades < 0.7) steps = {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0};
  std::vector<double> all;
  for (int decade = static_cast<int>(std::floor(axis.low)); decade <= axis.high; ++decade)
    for (const double step : steps) {
      const double value = step * std::pow(10.0, decade);
      if (std::log10(value) >= axis.low && std::log10(value) <= axis.high) all.push_back(value);
    }
  return all;
}

struct Drawing {
  const Chart& chart;
  Axis x, y;
  std::string out{};
  std::vector<LabelRequest> labels{};
  std::vector<const char*> label_colours{};
  Obstacles obstacles{{plot.left + 3, plot.top + 3, plot.right - 3, plot.bottom - 3}, {}, {}};

  bool shown(const ChartPoint& point) const { return point.time_s > 0.0; }
  /// Where a point is; stopped runs on top, errors of 0 at the bottom.
  Vec2 at(const ChartPoint& p) const {
    if (std::isnan(p.error_deg)) return {x(p.time_s), plot.top + 14};
    return {x(p.time_s), p.error_deg > 0.0 ? y(p.error_deg) : plot.bottom};
  }
  /// Those in ink (the case, presets) take their places before those of the dials.
  void label(const Vec2& where, double radius, const std::string& text, const char* colour) {
    const bool first = colour == ink;
    labels.insert(first ? labels.begin() : labels.end(), {where, radius, text});
    label_colours.insert(first ? label_colours.begin() : label_colours.end(), colour);
  }
  /// Keeps labels off a marker.
  void occupy(const Vec2& c, double r) {
    obstacles.boxes.push_back({c.x() - r, c.y() - r, c.x() + r, c.y() + r});
  }
};

void add_line(std::string& out, const Vec2& a, const Vec2& b, const char* colour, double thick) {
  out += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
                     "stroke-width=\"{}\"/>\n",
                     a.x(), a.y(), b.x(), b.y(), colour, thick);
}

void add_polyline(std::string& out, const std::vector<Vec2>& points, const char* colour,
                  double thick) {
  out += "<polyline fill=\"none\" points=\"";
  for (const Vec2& p : points)
    out += fmt::format("{:.1f},{:.1f} ", p.x(), p.y());
  out += fmt::format("\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"/>\n", colour,
                     thick);
}

void add_text(std::string& out, const Vec2& at, const std::string& text, double size,
              const char* colour, const char* more = "") {
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" fill=\"{}\"{}>{}</text>\n",
                     at.x(), at.y(), size, colour, more, xml(text));
}

/// The marker of dial `kind`: circle, square, triangle up or down.
void add_marker(std::string& out, const Vec2& c, std::size_t kind, const char* colour) {
  const auto polygon = [&](std::initializer_list<Vec2> corners) {
    out += "<polygon points=\"";
    for (const Vec2& p : corners)
      out += fmt::format("{:.1f},{:.1f} ", c.x() + p.x(), c.y() + p.y());
    out += fmt::format("\" fill=\"{}\" stroke=\"white\"/>\n", colour);
  };
  switch (kind % 4) {
  case 0:
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" fill=\"{}\" "
                       "stroke=\"white\"/>\n",
                       c.x(), c.y(), colour);
    break;
  case 1:
    polygon({{-4.5, -4.5}, {4.5, -4.5}, {4.5, 4.5}, {-4.5, 4.5}});
    break;
  case 2:
    polygon({{0, -6}, {5.5, 4}, {-5.5, 4}});
    break;
  default:
    polygon({{0, 6}, {5.5, -4}, {-5.5, -4}});
  }
}

void add_diamond(std::string& out, const Vec2& c) {
  out += fmt::format("<polygon points=\"{0:.1f},{1:.1f} {2:.1f},{3:.1f} {0:.1f},{4:.1f} "
                     "{5:.1f},{3:.1f}\" fill=\"#f0e442\" stroke=\"{6}\" stroke-width=\"1.2\"/>\n",
                     c.x(), c.y() - 7, c.x() + 7, c.y(), c.y() + 7, c.x() - 7, ink);
}

void add_dot(std::string& out, const Vec2& c) {
  out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"7\" fill=\"{}\" stroke=\"white\" "
                     "stroke-width=\"1.5\"/>\n",
                     c.x(), c.y(), ink);
}

void add_cross(std::string& out, const Vec2& c, const char* colour) {
  add_line(out, c + Vec2(-5, -5), c + Vec2(5, 5), colour, 2.2);
  add_line(out, c + Vec2(-5, 5), c + Vec2(5, -5), colour, 2.2);
}

void draw_grid(Drawing& d) {
  for (const double value : ticks(d.x)) {
    const double x = d.x(value);
    add_line(d.out, {x, plot.top}, {x, plot.bottom}, "#e6e6e6", 1);
    add_text(d.out, {x, plot.bottom + 18}, fmt::format("{:g}", value), label_size, ink,
             " text-anchor=\"middle\"");
  }
  for (const double value : ticks(d.y)) {
    const double y = d.y(value);
    add_line(d.out, {plot.left, y}, {plot.right, y}, "#e6e6e6", 1);
    add_text(d.out, {plot.left - 8, y + 4}, fmt::format("{:g}", value), label_size, ink,
             " text-anchor=\"end\"");
  }
  d.out += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" "
                       "stroke=\"{}\"/>\n",
                       plot.left, plot.top, plot.right - plot.left, plot.bottom - plot.top, grey);
  add_text(d.out, {0.5 * (plot.left + plot.right), plot.bottom + 42}, "wall time, s", 14, ink,
           " text-anchor=\"middle\"");
  const double middle = 0.5 * (plot.top + plot.bottom);
  add_text(d.out, {22, middle}, "error of the shear angle, rms, degrees", 14, ink,
           fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 22 {})\"", middle).c_str());
}

/// Grey steps: from each run of the front to the next, right and then down.
void draw_front(Drawing& d) {
  std::vector<Vec2> steps;
  for (const ChartPoint& point : d.chart.front) {
    if (!d.shown(point)) continue;
    const Vec2 p = d.at(point);
    steps.emplace_back(p.x(), steps.empty() ? plot.top : steps.back().y());
    steps.push_back(p);
  }
  if (steps.empty()) return;
  steps.emplace_back(plot.right, steps.back().y());
  add_polyline(d.out, steps, "#cfcfcf", 5);
  for (std::size_t i = 1; i < steps.size(); ++i)
    d.obstacles.lines.emplace_back(steps[i - 1], steps[i]);
}

void draw_dial(Drawing& d, std::size_t index) {
  const ChartLine& dial = d.chart.dials[index];
  const char* colour = colours[index % colour_count];
  std::vector<Vec2> joined;
  for (const ChartPoint& point : dial.points)
    if (d.shown(point) && !std::isnan(point.error_deg)) joined.push_back(d.at(point));
  d.out += fmt::format("<g id=\"dial{}\">\n<title>{}</title>\n", index, xml(dial.name));
  add_polyline(d.out, joined, colour, 2);
  for (std::size_t i = 1; i < joined.size(); ++i)
    d.obstacles.lines.emplace_back(joined[i - 1], joined[i]);
  for (const ChartPoint& point : dial.points) {
    if (!d.shown(point) || !point.marked) continue;
    const Vec2 p = d.at(point);
    if (std::isnan(point.error_deg))
      add_cross(d.out, p, colour);
    else
      add_marker(d.out, p, index, colour);
    d.occupy(p, 5);
    d.label(p, 4, point.label + (std::isnan(point.error_deg) ? " stopped" : ""),
            letters[index % colour_count]);
  }
  d.out += "</g>\n";
}

/// A diamond, and a bar at the error that the preset promises.
void draw_preset(Drawing& d, const ChartPoint& preset) {
  if (!d.shown(preset)) return;
  const Vec2 p = d.at(preset);
  if (preset.promised_deg > 0.0) {
    const double y = d.y(preset.promised_deg);
    add_line(d.out, p, {p.x(), y}, ink, 1);
    add_line(d.out, {p.x() - 11, y}, {p.x() + 11, y}, ink, 2.5);
    d.obstacles.lines.emplace_back(p, Vec2(p.x(), y));
    d.obstacles.boxes.push_back({p.x() - 11, y - 2, p.x() + 11, y + 2});
  }
  if (std::isnan(preset.error_deg))
    add_cross(d.out, p, ink);
  else
    add_diamond(d.out, p);
  d.occupy(p, 7);
  d.label(p, 6, preset.label, ink);
}

void draw_own(Drawing& d) {
  if (!d.shown(d.chart.own)) return;
  const Vec2 p = d.at(d.chart.own);
  if (std::isnan(d.chart.own.error_deg))
    add_cross(d.out, p, ink);
  else
    add_dot(d.out, p);
  d.occupy(p, 7);
  d.label(p, 6, d.chart.own.label, ink);
}

/// The reference has no error of its own: a mark on the lower edge.
void draw_reference(Drawing& d) {
  if (!(d.chart.reference_time_s > 0.0)) return;
  const Vec2 p(d.x(d.chart.reference_time_s), plot.bottom);
  add_line(d.out, p, p - Vec2(0, 12), ink, 2.5);
  d.obstacles.boxes.push_back({p.x() - 2, p.y() - 12, p.x() + 2, p.y()});
  d.label(p - Vec2(0, 9), 4, "reference run", ink);
}

void draw_labels(Drawing& d) {
  const std::vector<Vec2> places = place_labels(d.labels, label_size, d.obstacles);
  for (std::size_t i = 0; i < places.size(); ++i)
    add_text(d.out, places[i], d.labels[i].text, label_size, d.label_colours[i],
             " stroke=\"white\" stroke-width=\"3\" paint-order=\"stroke\"");
}

/// What each colour and mark is: a row below the title, more rows if it is long.
void draw_key(Drawing& d) {
  Vec2 at(plot.left, 76);
  const auto entry = [&](const std::string& name, double mark, auto&& draw) {
    const double wide = mark + 6 + text_width(name, label_size);
    if (at.x() > plot.left && at.x() + wide > plot.right) at = {plot.left, at.y() + 20};
    draw(Vec2(at.x() + 0.5 * mark, at.y() - 4));
    add_text(d.out, at + Vec2(mark + 6, 0), name, label_size, ink);
    at.x() += wide + 16;
  };
  for (std::size_t i = 0; i < d.chart.dials.size(); ++i)
    entry(d.chart.dials[i].name, 28, [&](const Vec2& c) {
      add_line(d.out, c - Vec2(14, 0), c + Vec2(14, 0), colours[i % colour_count], 2);
      add_marker(d.out, c, i, colours[i % colour_count]);
    });
  entry("the case", 14, [&](const Vec2& c) { add_dot(d.out, c); });
  bool promises = false;
  for (const ChartPoint& preset : d.chart.presets)
    promises |= preset.promised_deg > 0.0;
  if (!d.chart.presets.empty())
    entry(promises ? "--accuracy, bar: error it promises" : "--accuracy", 14,
          [&](const Vec2& c) { add_diamond(d.out, c); });
  if (!d.chart.front.empty())
    entry("best for its time", 28,
          [&](const Vec2& c) { add_line(d.out, c - Vec2(14, 0), c + Vec2(14, 0), "#cfcfcf", 5); });
}

/// Every time and every error of the chart.
void collect(const Chart& chart, std::vector<double>& times, std::vector<double>& errors) {
  const auto add = [&](const ChartPoint& point) {
    times.push_back(point.time_s);
    errors.push_back(point.error_deg);
    errors.push_back(point.promised_deg);
  };
  for (const ChartLine& dial : chart.dials)
    for (const ChartPoint& point : dial.points)
      add(point);
  for (const ChartPoint& preset : chart.presets)
    add(preset);
  add(chart.own);
  times.push_back(chart.reference_time_s);
}

} // namespace

std::string chart_svg(const Chart& chart) {
  std::vector<double> times, errors;
  collect(chart, times, errors);
  Drawing d{chart, axis_of(times, plot.left, plot.right, 0.09),
            axis_of(errors, plot.bottom, plot.top, 0.14)};
  d.out = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                      "viewBox=\"0 0 {0} {1}\" font-family=\"Helvetica, Arial, sans-serif\">\n"
                      "<title>{2}</title>\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
                      width, height, xml(chart.title));
  add_text(d.out, {plot.left, 30}, chart.title, 18, ink, " font-weight=\"bold\"");
  add_text(d.out, {plot.left, 49}, chart.note, 11, "#666666");
  draw_key(d);
  draw_grid(d);
  draw_front(d);
  for (std::size_t i = 0; i < chart.dials.size(); ++i)
    draw_dial(d, i);
  for (const ChartPoint& preset : chart.presets)
    draw_preset(d, preset);
  draw_own(d);
  draw_reference(d);
  draw_labels(d);
  return d.out + "</svg>\n";
}

} // namespace plyform
