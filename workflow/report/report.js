"use strict";
// Changes classes of Snakemake's report: a figure stands with its title and caption, a menu follows
// its question, icons have names, long lists of files are cut. `e` is React.createElement there,
// `results` the list of results.

const contentOf = ContentDisplay.prototype.renderContent;
ContentDisplay.prototype.renderContent = function () {
    const { content, contentPath } = this.props.app.state;
    const shown = Object.values(results).find((result) => result.data_uri === contentPath);
    if (content !== "img" || !shown) {
        return contentOf.call(this);
    }
    const title = Object.values(shown.labels).join(", ");
    return e(
        "figure",
        { className: "shown" },
        e("h2", {}, title),
        e("img", { src: contentPath, alt: title }),
        e("figcaption", { dangerouslySetInnerHTML: { __html: shown.caption } })
    );
};

AbstractResults.prototype.componentDidUpdate = function (before) {
    if (before.category !== this.props.category || before.searchTerm !== this.props.searchTerm) {
        const data = this.getData();
        this.setState({ data, toggles: this.getInitToggleState(data.toggleLabels) });
    }
};

const NAMES = { eye: "Show", "information-circle": "Caption and origin", home: "Start", x: "Hide", menu: "Menu" };
const iconOf = Icon.prototype.render;
Icon.prototype.render = function () {
    const svg = iconOf.call(this);
    // An icon beside a word has a class, and no name of its own.
    const name = this.props.className ? undefined : NAMES[this.props.iconName];
    const role = name ? { role: "img" } : { "aria-hidden": true };
    return React.cloneElement(svg, role, name && e("title", { key: "name" }, name), svg.props.children);
};

const AT_MOST = 12;
const itemsOf = RuleInfo.prototype.renderItems;
RuleInfo.prototype.renderItems = function (heading, items, ...rest) {
    const more = items.length - AT_MOST;
    const few = more > 0 ? [...items.slice(0, AT_MOST), `and ${more} more`] : items;
    return itemsOf.call(this, heading, few, ...rest);
};

if (app) {
    app.setView({}); // what stands already
}
